// Normal and plane of a single cell, computed directly by their definition.
#include "index/surface/cell_set.h"

#include "index/volume/cell_difference.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace isochron::index {
namespace {

/// The unit vector, computed without overflow or underflow of squares.
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

CellPlane cell_plane(const StepValues& values, const Query& query, CellId cell) {
    const std::array<std::uint32_t, 3> at = values.grid.cell_of(cell);
    const double level = stored_value(values.scaling, query.isovalue);
    return visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
        const CellDifferences<T> differences(values, query.instant.step, at[1], at[2]);
        const glm::dvec3 around = unit(differences(at[0]));
        const CellSlope slope = differences.slope(at[0], level);
        const double along = glm::dot(slope.own, unit(around * values.grid.even_size(at)));
        // `rise` is towards larger stored values; these are larger scaled ones if the slope is
        // positive.
        const double least = CellPlane::kLeastCosine2 * glm::dot(slope.own, slope.own);
        const double rise = along * std::abs(along) > least ? slope.rise / (2.0 * along) : 0.0;
        const double offset = values.scaling.slope < 0 ? rise : -rise;
        return CellPlane{unit(normal_from_difference(values) * around),
                         std::isfinite(offset) || std::isinf(offset)
                             ? std::clamp(offset, -CellPlane::kFarthest, CellPlane::kFarthest)
                             : 0.0};
    });
}

} // namespace isochron::index
