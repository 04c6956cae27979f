// The normal of a single cell, step by step as it is defined.
#include "index/extraction/cell_set.h"

#include "index/volume/cell_difference.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace isochron::index {
namespace {

/// Without overflow or underflow of the squares.
glm::dvec3 unit(const glm::dvec3& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    const double sum = v.x + v.y + v.z; // NaN where max() may have dropped one
    if (!(largest > 0) || !std::isfinite(largest) || std::isnan(sum))
        return glm::dvec3(0.0);
    const glm::dvec3 scaled = v / largest;
    return scaled / std::sqrt(glm::dot(scaled, scaled));
}

} // namespace

glm::dvec3 cell_normal(const StepValues& values, std::uint32_t step, CellId cell) {
    const std::array<std::uint32_t, 3> at = values.grid.cell_of(cell);
    return visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
        const glm::dvec3 difference = CellDifferences<T>(values, step, at[1], at[2])(at[0]);
        return unit(normal_from_difference(values) * unit(difference));
    });
}

} // namespace isochron::index
