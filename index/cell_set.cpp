// Positions and normals of active cells.
#include "index/cell_set.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace isochron::index {
namespace {

/// How the differences along one axis weigh the four planes around a cell: two vertices and their
/// outer neighbours, folded inwards at the border, where the difference is one-sided.
struct AxisTaps {
    AxisTaps(std::uint32_t cell, std::uint32_t vertices, std::ptrdiff_t step) {
        const bool first = cell == 0, last = cell + 2 == vertices;
        below = first ? 0 : -step;
        above = last ? step : 2 * step;
        low_weight = first ? 1.0 : 0.5;
        high_weight = last ? 1.0 : 0.5;
        next = step;
    }
    /// Sum of the differences at the cell's two vertices of one edge along this axis.
    template <class T>
    double operator()(const T* edge) const {
        return low_weight * (static_cast<double>(edge[next]) - static_cast<double>(edge[below])) +
               high_weight * (static_cast<double>(edge[above]) - static_cast<double>(edge[0]));
    }
    std::ptrdiff_t below, next, above;
    double low_weight, high_weight;
};

template <class T>
class Shader {
  public:
    Shader(const StepValues& values, std::uint32_t step)
        : n_(values.grid.vertices), data_(values.step<T>(step).data()), row_(n_[0]),
          slice_(std::ptrdiff_t{n_[0]} * n_[1]) {
        const glm::dmat3 physical_from_index(values.grid.physical_from_index());
        // Gradients are covectors; minus because a normal points towards lower values.
        normal_from_difference_ = glm::transpose(glm::inverse(physical_from_index)) *
                                  (values.scaling.slope < 0 ? 1.0 : -1.0);
    }

    glm::dvec3 normal(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
        const T* v = data_ + x + y * row_ + z * slice_;
        const AxisTaps dx(x, n_[0], 1), dy(y, n_[1], row_), dz(z, n_[2], slice_);
        const glm::dvec3 difference(dx(v) + dx(v + row_) + dx(v + slice_) + dx(v + row_ + slice_),
                                    dy(v) + dy(v + 1) + dy(v + slice_) + dy(v + 1 + slice_),
                                    dz(v) + dz(v + 1) + dz(v + row_) + dz(v + 1 + row_));
        return unit(normal_from_difference_ * unit(difference));
    }

  private:
    /// Without overflow or underflow of the squares.
    static glm::dvec3 unit(const glm::dvec3& v) {
        const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
        const double sum = v.x + v.y + v.z; // NaN where max() may have dropped one
        if (!(largest > 0) || !std::isfinite(largest) || std::isnan(sum))
            return glm::dvec3(0.0);
        const glm::dvec3 scaled = v / largest;
        return scaled / std::sqrt(glm::dot(scaled, scaled));
    }

    std::array<std::uint32_t, 3> n_;
    const T* data_;
    std::ptrdiff_t row_, slice_;
    glm::dmat3 normal_from_difference_;
};

/// GL_INT_2_10_10_10_REV: x in the lowest bits, 511 is 1.
std::uint32_t packed(const glm::dvec3& unit) {
    const auto bits = [](double component) {
        return static_cast<std::uint32_t>(std::lround(component * 511.0)) & 0x3ff;
    };
    return bits(unit.x) | bits(unit.y) << 10 | bits(unit.z) << 20;
}

template <class T>
bool shade(const StepValues& values, CellSet& set, const std::stop_token& stop) {
    const Shader<T> shader(values, set.query.step);
    const std::uint32_t width = values.grid.cells()[0];
    std::uint64_t row_end = 0; // id behind the current row
    CellPoint point{};
    for (std::size_t i = 0; i < set.ids.size(); ++i) {
        const CellId id = set.ids[i];
        if (i % 4096 == 0 && stop.stop_requested())
            return false;
        if (id >= row_end) {
            const auto [x, y, z] = values.grid.cell_of(id);
            point.y = static_cast<std::uint16_t>(y);
            point.z = static_cast<std::uint16_t>(z);
            row_end = std::uint64_t{id} - x + width;
            set.rows.push_back({point.y, point.z, static_cast<std::uint32_t>(i)});
        }
        point.x = static_cast<std::uint16_t>(id - (row_end - width));
        point.normal = packed(shader.normal(point.x, point.y, point.z));
        set.points.push_back(point);
    }
    return true;
}

} // namespace

bool shade_cells(const StepValues& values, CellSet& set, const std::stop_token& stop) {
    set.points.clear();
    set.rows.clear();
    set.points.reserve(set.ids.size());
    return visit_value_type(
        values.type, [&]<class T>(std::type_identity<T>) { return shade<T>(values, set, stop); });
}

glm::dvec3 cell_normal(const StepValues& values, std::uint32_t step, CellId cell) {
    const auto [x, y, z] = values.grid.cell_of(cell);
    return visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
        return Shader<T>(values, step).normal(x, y, z);
    });
}

} // namespace isochron::index
