// Where a volume first stands in the room.
#include "app/config/first_placement.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>

namespace isochron::app {
namespace {

/// Rotation whose columns are the room directions of physical +x, +y and +z.
glm::dquat upright(index::Anatomy anatomy) {
    const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    switch (anatomy) {
    case index::Anatomy::ras:
        return glm::quat_cast(glm::dmat3(-x, z, y)); // right, anterior, superior
    case index::Anatomy::lps:                        // left, posterior, superior
    case index::Anatomy::enu:                        // east, north, up
        return glm::quat_cast(glm::dmat3(x, -z, y));
    default: return glm::dquat(1, 0, 0, 0);
    }
}

} // namespace

glm::dvec3 physical_size(const index::Grid& grid) {
    glm::dvec3 size;
    for (int axis = 0; axis < 3; ++axis)
        size[axis] = grid.cells()[axis] * grid.spacing[axis];
    return size;
}

glm::dvec3 physical_center(const index::Grid& grid) {
    glm::dvec3 middle;
    for (int axis = 0; axis < 3; ++axis)
        middle[axis] = (grid.vertices[axis] - 1) / 2.0;
    return glm::dvec3(grid.physical_from_index() * glm::dvec4(middle, 1.0));
}

interaction::Similarity place(const index::SeriesInfo& info, const PlacementOptions& options) {
    const glm::dvec3 size = physical_size(info.grid);
    interaction::Similarity home;
    home.scale = options.size / std::max({size.x, size.y, size.z});
    home.rotation = upright(info.anatomy);
    home.translation = glm::dvec3(0, options.height, -options.distance) -
                       home.scale * (home.rotation * physical_center(info.grid));
    return home;
}

interaction::DataFrame data_frame(const index::SeriesInfo& info) {
    const auto cells = info.grid.cells();
    const glm::dmat4 index_from_box =
        glm::scale(glm::dmat4(1.0), glm::dvec3(cells[0], cells[1], cells[2]));
    return {info.grid.physical_from_index() * index_from_box, info.length_unit};
}

} // namespace isochron::app
