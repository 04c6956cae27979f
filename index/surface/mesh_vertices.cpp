// Computes cuts of edges, and central differences at both ends of edges.
#include "index/surface/mesh_vertices.h"

#include "index/volume/cell_difference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

namespace isochron::index {
namespace {

std::uint32_t octahedral(std::int32_t u, std::int32_t v) {
    return static_cast<std::uint16_t>(u) | std::uint32_t{static_cast<std::uint16_t>(v)} << 16;
}

/// Rounds halves away from zero; the argument's size is at most MeshVertex::kOne.
template <class Real>
std::int32_t rounded(Real value) {
    return static_cast<std::int32_t>(value + std::copysign(Real{0.5}, value));
}

template <class Real>
using Vector = std::array<Real, 3>;

/// @param n a vector of any finite length
template <class Real>
std::uint32_t pack_normal(const Vector<Real>& n) {
    const Real sum = std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]);
    if (!(sum > 0) || !(sum < std::numeric_limits<Real>::infinity()))
        return MeshVertex::kNoNormal;
    const Real scale = MeshVertex::kOne / sum;
    const Real u = n[0] * scale, v = n[1] * scale, one = MeshVertex::kOne;
    const bool below = n[2] < 0;
    const Real folded_u = std::copysign(one - std::abs(v), u);
    const Real folded_v = std::copysign(one - std::abs(u), v);
    return octahedral(rounded(below ? folded_u : u), rounded(below ? folded_v : v));
}

/// Differences of small types are exact in `float`; for `float` values it is as precise as they
/// are.
template <class T>
using RealFor = std::conditional_t<sizeof(T) <= 2 || std::is_same_v<T, float>, float, double>;

template <class T, class Real = RealFor<T>>
class VertexPlacer {
  public:
    VertexPlacer(const StepValues& values, const Query& query, std::uint32_t first_plane)
        : grid_(values.grid), counts_(values.grid.vertices),
          first_plane_(first_plane), steps_{1, std::ptrdiff_t{counts_[0]},
                                            std::ptrdiff_t{counts_[0]} * counts_[1]},
          volume_(values.step<T>(query.instant.step).data()),
          level_(stored_value(values.scaling, query.isovalue)) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            inner_[axis] = grid_.rectilinear() ? 0 : std::max(counts_[axis], 3u) - 3;
        double smallest = 0;
        const glm::dmat3 matrix = scaled_to_one(normal_from_difference(values), smallest);
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                matrix_[row][column] = static_cast<Real>(matrix[column][row]);
    }

    void place(MeshVertex& vertex) const {
        const std::array<std::uint32_t, 3> at{vertex.x, vertex.y, vertex.z - first_plane_};
        const std::size_t axis = vertex.axis;
        const T* const low = volume_ + at[0] + at[1] * steps_[1] + at[2] * steps_[2];
        const T* const high = low + steps_[axis];
        const double share = share_between(static_cast<double>(*low), static_cast<double>(*high));
        // NOLINTNEXTLINE(bugprone-incorrect-roundings): never negative, and lround costs a call
        vertex.share = static_cast<std::uint32_t>(share * MeshVertex::kWhole + 0.5);
        Vector<Real> from, to;
        if (is_inner(at)) {
            from = inner_difference(low);
            to = inner_difference(high);
        } else {
            std::array<std::uint32_t, 3> end = at;
            ++end[axis];
            from = difference(low, at);
            to = difference(high, end);
        }
        if constexpr (std::is_floating_point_v<T>) {
            from = finite_or_zero(from);
            to = finite_or_zero(to);
        }
        vertex.normal = normal(from, to, static_cast<Real>(share));
    }

  private:
    double share_between(double low, double high) const {
        double share = (level_ - low) / (high - low);
        if constexpr (std::is_floating_point_v<T>)
            if (!std::isfinite(high - low))
                share = far_share(low, high);
        return std::clamp(share, 0.0, 1.0);
    }
    /// The share if an end, or the difference of both, is infinite.
    double far_share(double low, double high) const {
        if (std::isfinite(low) && std::isfinite(high))
            return (level_ / 2 - low / 2) / (high / 2 - low / 2);
        return std::isfinite(low) ? 0.0 : std::isfinite(high) ? 1.0 : 0.5;
    }

    /// Whether both ends of any edge from here have neighbors on all sides.
    bool is_inner(const std::array<std::uint32_t, 3>& at) const {
        // Numbers are unsigned, so 0 is not inner either.
        return at[0] - 1 < inner_[0] && at[1] - 1 < inner_[1] && at[2] - 1 < inner_[2];
    }

    /// Twice the central difference.
    Vector<Real> inner_difference(const T* v) const {
        Vector<Real> result;
        for (std::size_t axis = 0; axis < 3; ++axis)
            result[axis] = static_cast<Real>(v[steps_[axis]]) - static_cast<Real>(v[-steps_[axis]]);
        return result;
    }
    /// Differences that are one-sided at the border, and twice the slope where vertices are uneven.
    Vector<Real> difference(const T* v, const std::array<std::uint32_t, 3>& at) const {
        Vector<Real> result;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!grid_.positions[axis].even()) {
                result[axis] = static_cast<Real>(2 * slope(v, axis, at[axis]));
                continue;
            }
            const std::ptrdiff_t below = at[axis] > 0 ? -steps_[axis] : 0;
            const std::ptrdiff_t above = at[axis] + 1 < counts_[axis] ? steps_[axis] : 0;
            const Real part = below != 0 && above != 0 ? 1 : 2;
            result[axis] = part * (static_cast<Real>(v[above]) - static_cast<Real>(v[below]));
        }
        return result;
    }

    double slope(const T* v, std::size_t axis, std::uint32_t at) const {
        const auto weights = grid_.slope_weights(static_cast<int>(axis), at);
        const auto here = static_cast<double>(*v);
        double sum = 0;
        if (at > 0)
            sum += weights.before * (here - static_cast<double>(v[-steps_[axis]]));
        if (at + 1 < counts_[axis])
            sum += weights.behind * (static_cast<double>(v[steps_[axis]]) - here);
        return sum;
    }

    static Vector<Real> finite_or_zero(const Vector<Real>& v) {
        const bool finite = std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
        return finite ? v : Vector<Real>{};
    }

    std::uint32_t normal(const Vector<Real>& from, const Vector<Real>& to, Real share) const {
        Vector<Real> mixed, n;
        for (std::size_t i = 0; i < 3; ++i)
            mixed[i] = (1 - share) * from[i] + share * to[i];
        for (std::size_t i = 0; i < 3; ++i)
            n[i] = matrix_[i][0] * mixed[0] + matrix_[i][1] * mixed[1] + matrix_[i][2] * mixed[2];
        return pack_normal(n);
    }

    const Grid& grid_;
    std::array<std::uint32_t, 3> counts_, inner_{};
    std::uint32_t first_plane_;
    std::array<std::ptrdiff_t, 3> steps_;
    const T* volume_;
    double level_; ///< among stored values
    std::array<Vector<Real>, 3> matrix_;
};

} // namespace

void place_vertices(const StepValues& values, const Query& query, std::uint32_t first_plane,
                    std::span<MeshVertex> vertices) {
    visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
        const VertexPlacer<T> placer(values, query, first_plane);
        for (MeshVertex& vertex : vertices)
            placer.place(vertex);
    });
}

} // namespace isochron::index
