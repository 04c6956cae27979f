// Where the vertices and cells of a grid lie along its axes.
#include "render/cells/axis_places.h"

#include <algorithm>
#include <cstddef>

namespace isochron::render {

std::array<AxisPlaces, 3> axis_places(const index::Grid& grid) {
    std::array<AxisPlaces, 3> axes;
    for (int axis = 0; axis < 3; ++axis) {
        const std::uint32_t count = grid.vertices[static_cast<std::size_t>(axis)];
        AxisPlaces& of_axis = axes[static_cast<std::size_t>(axis)];
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t cell = std::min(i, count - 2);
            const double low = grid.even_place(axis, cell);
            of_axis.place.push_back(static_cast<float>(grid.even_place(axis, i)));
            of_axis.side.push_back(static_cast<float>(grid.even_place(axis, cell + 1) - low));
        }
    }
    return axes;
}

} // namespace isochron::render
