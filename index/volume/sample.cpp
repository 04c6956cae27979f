// Trilinear interpolation at a place.
#include "index/volume/sample.h"

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace isochron::index {

std::optional<double> value_at(const StepValues& values, std::uint32_t step, const glm::dvec3& at) {
    const auto cells = values.grid.cells();
    const glm::dvec3 extent(cells[0], cells[1], cells[2]);
    const glm::dvec3 place(glm::inverse(values.grid.physical_from_index()) * glm::dvec4(at, 1.0));
    for (int axis = 0; axis < 3; ++axis)
        if (!(place[axis] >= 0 && place[axis] <= extent[axis]))
            return std::nullopt;
    const glm::dvec3 low = glm::min(glm::floor(place), extent - 1.0), local = place - low;
    const auto [nx, ny, nz] = values.grid.vertices;
    const auto first =
        (static_cast<std::size_t>(low.z) * ny + static_cast<std::size_t>(low.y)) * nx +
        static_cast<std::size_t>(low.x);
    double sum = 0;
    for (std::size_t corner = 0; corner < 8; ++corner) {
        const std::size_t x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
        const std::size_t vertex = first + (z * ny + y) * nx + x;
        const double value = visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
            return values.scaling(static_cast<double>(values.step<T>(step)[vertex]));
        });
        sum += value * (x ? local.x : 1 - local.x) * (y ? local.y : 1 - local.y) *
               (z ? local.z : 1 - local.z);
    }
    // A vertex of no weight that is not a number makes none of the sum either.
    return std::isfinite(sum) ? std::optional(sum) : std::nullopt;
}

} // namespace isochron::index
