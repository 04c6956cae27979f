// Combines a grid's geometry with its place in the room.
#include "render/cells/placement.h"

#include <cmath>

namespace isochron::render {

Placement Placement::of(const index::Grid& grid, const glm::dmat4& room_from_physical) {
    const auto cells = grid.cells();
    return {glm::mat4(room_from_physical * grid.physical_from_index()),
            glm::mat3(room_from_physical), glm::vec3(cells[0], cells[1], cells[2]),
            grid.rectilinear() ? std::optional(grid) : std::nullopt};
}

glm::mat3 Placement::room_from_normal() const {
    const glm::mat3& linear = room_from_physical;
    const glm::mat3 square = glm::transpose(linear) * linear;
    const float size2 = square[0][0];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (std::abs(square[i][j] - (i == j ? size2 : 0.0f)) > 1e-5f * size2)
                return size2 * glm::transpose(glm::inverse(linear)); // heights are exaggerated
    return linear;
}

glm::vec3 Placement::index_at(const glm::vec3& even) const {
    glm::vec3 index = even;
    for (int axis = 0; rectilinear && axis < 3; ++axis)
        index[axis] = static_cast<float>(
            rectilinear->index_at(axis, even[axis] * rectilinear->spacing[axis]));
    return index;
}

} // namespace isochron::render
