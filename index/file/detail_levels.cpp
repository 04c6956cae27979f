// Making of coarser levels: along x, then y, then z, plane by plane.
#include "index/file/detail_levels.h"

#include "index/file/chunk_grid.h"
#include "index/system/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace isochron::index {
namespace {

/// Vertices of the next level along an axis.
constexpr std::uint32_t coarser(std::uint32_t vertices) {
    return vertices / 2 + 1;
}

/// What a vertex of the next level is made of along one axis.
struct Taps {
    Taps(std::uint32_t place, std::uint32_t vertices)
        : middle(std::min(2 * place, vertices - 1)), below(middle > 0),
          above(middle + 1 < vertices) {}
    int weight() const { return 2 + (below ? 1 : 0) + (above ? 1 : 0); }

    std::uint32_t middle;
    bool below, above; ///< whether there are such neighbors
};

/// Sums of values, and of the weights of those that are not missing.
template <class Sum>
struct Sums {
    std::vector<Sum> values, weights;
    void resize(std::size_t size, bool weighted) {
        values.resize(size);
        weights.resize(weighted ? size : 0);
    }
};

/// (a + 2 b) + c of rows, without those that are not there.
template <class Sum>
void add_rows(const Taps& taps, const Sum* middle, std::size_t stride, std::size_t count,
              Sum* out) {
    const Sum* below = taps.below ? middle - stride : middle;
    const Sum* above = taps.above ? middle + stride : middle;
    if (taps.below && taps.above)
        for (std::size_t i = 0; i < count; ++i)
            out[i] = (below[i] + 2 * middle[i]) + above[i];
    else if (taps.below)
        for (std::size_t i = 0; i < count; ++i)
            out[i] = below[i] + 2 * middle[i];
    else
        for (std::size_t i = 0; i < count; ++i)
            out[i] = 2 * middle[i] + (taps.above ? above[i] : Sum(0));
}

template <class T>
class Coarsening {
  public:
    static constexpr bool kFloat = std::is_floating_point_v<T>;
    using Sum = std::conditional_t<kFloat, double, std::int64_t>;

    Coarsening(const Grid& grid, const T* stored, T* out)
        : from_(grid.vertices), to_{coarser(from_[0]), coarser(from_[1]), coarser(from_[2])},
          stored_(stored), out_(out) {}

    std::uint32_t planes() const { return to_[2]; }

    /// Makes one plane of the next level.
    void plane(std::uint32_t z) {
        const Taps taps(z, from_[2]);
        const std::size_t size = std::size_t{to_[0]} * to_[1];
        sum_.resize(3 * size, kFloat);
        // Those that are not there stay out of the sum below.
        for (std::uint32_t i = taps.below ? 0 : 1; i < (taps.above ? 3u : 2u); ++i)
            reduce(taps.middle + i - 1, i * size);
        result_.resize(size, kFloat);
        add_rows(taps, sum_.values.data() + size, size, size, result_.values.data());
        if constexpr (kFloat)
            add_rows(taps, sum_.weights.data() + size, size, size, result_.weights.data());
        T* const out = out_ + z * size;
        for (std::uint32_t y = 0; y < to_[1]; ++y)
            for (std::uint32_t x = 0; x < to_[0]; ++x) {
                const std::size_t i = std::size_t{y} * to_[0] + x;
                if constexpr (kFloat) {
                    out[i] = static_cast<T>(result_.values[i] / result_.weights[i]);
                } else {
                    const std::int64_t weight =
                        taps.weight() * Taps(y, from_[1]).weight() * Taps(x, from_[0]).weight();
                    out[i] = static_cast<T>(floor_div(2 * result_.values[i] + weight, 2 * weight));
                }
            }
    }

  private:
    static std::int64_t floor_div(std::int64_t a, std::int64_t b) {
        return a / b - (a % b < 0 ? 1 : 0);
    }

    /// One plane of the level below, along x and y.
    void reduce(std::uint32_t z, std::size_t at) {
        rows_.resize(std::size_t{to_[0]} * from_[1], kFloat);
        for (std::uint32_t y = 0; y < from_[1]; ++y)
            reduce_row(stored_ + (std::size_t{z} * from_[1] + y) * from_[0],
                       std::size_t{y} * to_[0]);
        for (std::uint32_t y = 0; y < to_[1]; ++y) {
            const Taps taps(y, from_[1]);
            const std::size_t row = std::size_t{taps.middle} * to_[0];
            const std::size_t out = at + std::size_t{y} * to_[0];
            add_rows(taps, rows_.values.data() + row, to_[0], to_[0], sum_.values.data() + out);
            if constexpr (kFloat)
                add_rows(taps, rows_.weights.data() + row, to_[0], to_[0],
                         sum_.weights.data() + out);
        }
    }

    void reduce_row(const T* row, std::size_t at) {
        values_.resize(from_[0]);
        weights_.resize(kFloat ? from_[0] : 0);
        for (std::uint32_t x = 0; x < from_[0]; ++x) {
            if constexpr (kFloat) {
                const bool there = row[x] == row[x];
                values_[x] = there ? static_cast<Sum>(row[x]) : Sum(0);
                weights_[x] = there ? 1 : 0;
            } else {
                values_[x] = row[x];
            }
        }
        reduce_along_x(values_, rows_.values.data() + at);
        if constexpr (kFloat)
            reduce_along_x(weights_, rows_.weights.data() + at);
    }

    void reduce_along_x(const std::vector<Sum>& row, Sum* out) const {
        for (const std::uint32_t x : {0u, to_[0] - 1}) {
            const Taps taps(x, from_[0]);
            add_rows(taps, row.data() + taps.middle, 1, 1, out + x);
        }
        for (std::uint32_t x = 1; x + 1 < to_[0]; ++x)
            out[x] = (row[2 * x - 1] + 2 * row[2 * x]) + row[2 * x + 1];
    }

    std::array<std::uint32_t, 3> from_, to_;
    const T* stored_;
    T* out_;
    Sums<Sum> rows_;                    ///< of a plane below, reduced along x
    Sums<Sum> sum_;                     ///< of up to three planes, along x and y
    Sums<Sum> result_;                  ///< of the plane
    std::vector<Sum> values_, weights_; ///< of a row below
};

} // namespace

std::vector<Grid> detail_grids(const Grid& grid) {
    std::vector<Grid> grids{grid};
    while (std::ranges::any_of(grids.back().vertices,
                               [](std::uint32_t vertices) { return vertices > kChunkEdge; })) {
        Grid next = grids.back();
        for (std::uint32_t& vertices : next.vertices)
            vertices = coarser(vertices);
        next.spacing *= 2.0;
        grids.push_back(next);
    }
    return grids;
}

void coarsen(ValueType type, const Grid& grid, std::span<const std::byte> stored,
             std::span<std::byte> out, unsigned threads) {
    visit_value_type(type, [&]<class T>(std::type_identity<T>) {
        const Coarsening<T> work(grid, reinterpret_cast<const T*>(stored.data()),
                                 reinterpret_cast<T*>(out.data()));
        // Threads take time to start: not for the smallest steps.
        const unsigned used = stored.size() > (std::size_t{1} << 20) ? threads : 1;
        std::vector<Coarsening<T>> workers(used, work);
        parallel_for(work.planes(), used,
                     [&](std::size_t z, unsigned worker) {
                         workers[worker].plane(static_cast<std::uint32_t>(z));
                     },
                     {});
    });
}

} // namespace isochron::index
