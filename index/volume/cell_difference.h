// Differences of values around a cell, from which its normal is made.
#pragma once

#include "index/volume/step_values.h"

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace isochron::index {

/// Weights of the four planes around a cell in the differences along one axis: the planes of its
/// two vertices and their outer neighbors. At the border, differences are one-sided.
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

/// Differences on a rectilinear grid, where they are slopes per even coordinate
/// (`Grid::slope_weights`). Apart from AxisTaps, as it takes twice the time.
struct UnevenAxisTaps {
    UnevenAxisTaps(const Grid& grid, std::size_t axis, std::uint32_t cell, std::ptrdiff_t step)
        : taps(cell, grid.vertices[axis], step), even(grid.positions[axis].even()) {
        if (!even) {
            low = grid.slope_weights(static_cast<int>(axis), cell);
            high = grid.slope_weights(static_cast<int>(axis), cell + 1);
        }
    }
    template <class T>
    double operator()(const T* edge) const {
        if (even)
            return taps(edge);
        const auto difference = [edge](std::ptrdiff_t from, std::ptrdiff_t to) {
            return static_cast<double>(edge[to]) - static_cast<double>(edge[from]);
        };
        double sum = (low.behind + high.before) * difference(0, taps.next);
        if (taps.below != 0)
            sum += low.before * difference(taps.below, 0);
        if (taps.above != taps.next)
            sum += high.behind * difference(taps.next, taps.above);
        return sum;
    }
    AxisTaps taps;
    bool even;
    Grid::SlopeWeights low, high;
};

/// The slope of a cell's own eight values, and the way from their mean to the isovalue.
struct CellSlope {
    glm::dvec3 own; ///< four times the mean difference along each axis, index space
    double rise;    ///< eight times (isovalue - mean)
};

/// The stored value of a scaled one.
inline double stored_value(const Scaling& scaling, double scaled) {
    return (scaled - scaling.intercept) / scaling.slope;
}

/// The cells of one row of a step.
template <class T>
class CellDifferences {
  public:
    CellDifferences(const StepValues& values, std::uint32_t step, std::uint32_t y, std::uint32_t z)
        : nx_(values.grid.vertices[0]), row_(nx_),
          slice_(std::ptrdiff_t{nx_} * values.grid.vertices[1]), grid_(values.grid), y_(y), z_(z),
          regular_(!grid_.rectilinear()), dy_(y, grid_.vertices[1], row_),
          dz_(z, grid_.vertices[2], slice_),
          first_(values.step<T>(step).data() + y * row_ + z * slice_) {}

    /// Four times the mean, over the eight vertices, of the difference along each axis, per unit of
    /// even coordinates.
    glm::dvec3 operator()(std::uint32_t x) const {
        return regular_ ? sums(x, AxisTaps(x, nx_, 1), dy_, dz_) : uneven_sums(x);
    }
    /// @param level isovalue among stored values
    CellSlope slope(std::uint32_t x, double level) const {
        std::array<double, 8> v;
        double rise = 0;
        for (int i = 0; i < 8; ++i) {
            const std::ptrdiff_t at = x + (i & 1) + (i >> 1 & 1) * row_ + (i >> 2) * slice_;
            v[i] = static_cast<double>(first_[at]);
            rise += level - v[i];
        }
        return {{(v[1] - v[0]) + (v[3] - v[2]) + (v[5] - v[4]) + (v[7] - v[6]),
                 (v[2] - v[0]) + (v[3] - v[1]) + (v[6] - v[4]) + (v[7] - v[5]),
                 (v[4] - v[0]) + (v[5] - v[1]) + (v[6] - v[2]) + (v[7] - v[3])},
                rise};
    }

  private:
    template <class Taps>
    glm::dvec3 sums(std::uint32_t x, const Taps& dx, const Taps& dy, const Taps& dz) const {
        const T* v = first_ + x;
        return {dx(v) + dx(v + row_) + dx(v + slice_) + dx(v + row_ + slice_),
                dy(v) + dy(v + 1) + dy(v + slice_) + dy(v + 1 + slice_),
                dz(v) + dz(v + 1) + dz(v + row_) + dz(v + 1 + row_)};
    }
    [[gnu::noinline]] glm::dvec3 uneven_sums(std::uint32_t x) const {
        return sums(x, UnevenAxisTaps(grid_, 0, x, 1), UnevenAxisTaps(grid_, 1, y_, row_),
                    UnevenAxisTaps(grid_, 2, z_, slice_));
    }

    std::uint32_t nx_;
    std::ptrdiff_t row_, slice_;
    const Grid& grid_;
    std::uint32_t y_, z_;
    bool regular_;
    AxisTaps dy_, dz_; ///< for regular grids
    const T* first_;
};

/// Matrix that turns differences into vectors along the normal, in physical space: gradients are
/// covectors, and the sign makes normals point towards lower scaled values.
inline glm::dmat3 normal_from_difference(const StepValues& values) {
    const glm::dmat3 physical_from_index(values.grid.physical_from_index());
    return glm::transpose(glm::inverse(physical_from_index)) *
           (values.scaling.slope < 0 ? 1.0 : -1.0);
}

/// The matrix divided by its largest entry, so that its results keep their direction.
/// @param smallest_column set to the least, over the result's columns, of their largest entries
inline glm::dmat3 scaled_to_one(glm::dmat3 matrix, double& smallest_column) {
    double largest = 0;
    smallest_column = std::numeric_limits<double>::infinity();
    for (int column = 0; column < 3; ++column) {
        const glm::dvec3 v = glm::abs(matrix[column]);
        const double most = std::max({v.x, v.y, v.z});
        largest = std::max(largest, most);
        smallest_column = std::min(smallest_column, most);
    }
    smallest_column /= largest;
    return matrix / largest;
}

} // namespace isochron::index
