// Trilinear interpolation at a place.
#include "index/volume/sample.h"

#include <glm/common.hpp>

#include <cmath>

namespace isochron::index {

std::optional<double> value_at(const Grid& grid, const glm::dvec3& at,
                               const ScaledVertex& vertex_value) {
    const auto cells = grid.cells();
    const glm::dvec3 extent(cells[0], cells[1], cells[2]);
    const glm::dvec3 place = grid.index_of(at);
    for (int axis = 0; axis < 3; ++axis)
        if (!(place[axis] >= 0 && place[axis] <= extent[axis]))
            return std::nullopt;
    const glm::dvec3 low = glm::min(glm::floor(place), extent - 1.0), local = place - low;
    double sum = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const unsigned x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
        const double value = vertex_value({static_cast<std::uint32_t>(low.x) + x,
                                           static_cast<std::uint32_t>(low.y) + y,
                                           static_cast<std::uint32_t>(low.z) + z});
        sum += value * (x ? local.x : 1 - local.x) * (y ? local.y : 1 - local.y) *
               (z ? local.z : 1 - local.z);
    }
    // NaN and infinite vertices make the sum NaN or infinite, even those with weight 0.
    return std::isfinite(sum) ? std::optional(sum) : std::nullopt;
}

std::optional<double> value_at(const StepValues& values, std::uint32_t step, const glm::dvec3& at) {
    const auto& n = values.grid.vertices;
    return value_at(values.grid, at, [&](const std::array<std::uint32_t, 3>& v) {
        return visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
            const std::size_t vertex = (std::size_t{v[2]} * n[1] + v[1]) * n[0] + v[0];
            return values.scaling(static_cast<double>(values.step<T>(step)[vertex]));
        });
    });
}

} // namespace isochron::index
