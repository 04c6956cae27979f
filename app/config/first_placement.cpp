// Where a volume first stands in the room.
#include "app/config/first_placement.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>

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

constexpr double kFlat = 0.25;             ///< thickness of a slab over its width, at most
const double kSeenAt = glm::radians(35.0); ///< between a slab's normal and the way to the viewer

/// Turns a flat slab that is seen from its edge until its broad side is seen, from above if it
/// lies.
glm::dquat facing_viewer(const index::Grid& grid, const glm::dquat& rotation) {
    const glm::dvec3 size = physical_size(grid);
    int thin = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (size[axis] < size[thin])
            thin = axis;
    const double width = std::min(size[(thin + 1) % 3], size[(thin + 2) % 3]);
    if (size[thin] > kFlat * width)
        return rotation;
    const glm::dvec3 towards_viewer(0, 0, 1);
    glm::dvec3 normal = rotation * grid.direction[thin];
    if (normal.y + 1e-6 * normal.z < 0) // the upper side
        normal = -normal;
    const double angle = std::acos(std::clamp(glm::dot(normal, towards_viewer), -1.0, 1.0));
    if (std::min(angle, glm::pi<double>() - angle) <= kSeenAt + 1e-9)
        return rotation;
    const glm::dvec3 around = glm::normalize(glm::cross(normal, towards_viewer));
    return glm::normalize(glm::angleAxis(angle - kSeenAt, around) * rotation);
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
    home.rotation = facing_viewer(info.grid, upright(info.anatomy));
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
