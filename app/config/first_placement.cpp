// Where a volume first stands in the room.
#include "app/config/first_placement.h"

#include "interaction/navigation/axis_views.h"
#include "stereo/screen.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

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

/// From the right, above and before: the front is where `place` has the viewer.
interaction::AxisView corner_view(index::Anatomy anatomy) {
    interaction::AxisView view = interaction::axis_views()[interaction::kIsometric];
    if (anatomy == index::Anatomy::ras)
        view.towards_eye = {-1, 1, 1}; // anterior is the front
    return view;
}

using Corners = std::array<glm::dvec4, 8>;

Corners corners_in_clip(const glm::dmat4& clip_from_physical, const index::Grid& grid) {
    Corners corners;
    for (unsigned corner = 0; corner < 8; ++corner) {
        glm::dvec4 index(0, 0, 0, 1);
        for (int axis = 0; axis < 3; ++axis)
            index[axis] = (corner >> axis & 1) != 0 ? grid.cells()[axis] : 0;
        corners[corner] = clip_from_physical * grid.physical_from_index() * index;
    }
    return corners;
}

/// Halves the range between a value that is too low and one that is too high until they meet.
template <class TooLow>
double between(double low, double high, const TooLow& is_too_low) {
    constexpr int kHalvings = 60;
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = (low + high) / 2;
        (is_too_low(middle) ? low : high) = middle;
    }
    return (low + high) / 2;
}

/// The ends of what a picture shows of the box, from -1 to 1 across it.
/// @param moved by so much along one axis of clip space, parallel to the screen
std::array<double, 2> ends_of(const Corners& corners, int axis, double moved) {
    std::array ends{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
    for (const glm::dvec4& corner : corners) {
        const double at = (corner[axis] + moved) / corner.w;
        ends = {std::min(ends[0], at), std::max(ends[1], at)};
    }
    return ends;
}

/// How far the box has to be moved so that it is in the middle of the picture.
double to_middle(const Corners& corners, int axis) {
    constexpr double kFar = 100; // in clip space: many pictures away
    return between(-kFar, kFar, [&](double moved) {
        const auto [low, high] = ends_of(corners, axis, moved);
        return low + high < 0;
    });
}

/// Whether the box in the middle of the picture is smaller than a share of it.
bool is_small(const Corners& corners, double share, double nearest) {
    for (const glm::dvec4& corner : corners)
        if (corner.w < nearest)
            return false;
    for (int axis = 0; axis < 2; ++axis) {
        const auto [low, high] = ends_of(corners, axis, to_middle(corners, axis));
        if (high - low > 2 * share)
            return false;
    }
    return true;
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

interaction::Similarity filling(const index::SeriesInfo& info, const PlacementOptions& options,
                                const stereo::Screen& screen, const interaction::Pose& head,
                                glm::ivec2 picture) {
    const glm::dvec3 center = physical_center(info.grid);
    const interaction::Similarity placement =
        seen_from(corner_view(info.anatomy), place(info, options), center, head);
    const render::View view =
        stereo::view_of(screen, head, stereo::Eye::center, 0, 0.05f, 50.0f, picture);
    const glm::dmat4 eye_from_room(view.eye_from_room);
    const glm::dmat4 clip_from_room = glm::dmat4(view.clip_from_eye) * eye_from_room;
    const glm::dvec3 in_room = transform(placement, center);
    const auto corners_at = [&](double scale) {
        interaction::Similarity scaled = placement;
        scaled.scale = scale;
        scaled.translation += in_room - transform(scaled, center);
        return std::pair(scaled, corners_in_clip(clip_from_room * matrix(scaled), info.grid));
    };
    constexpr double kMost = 100;    // times as large as `options.size`
    constexpr double kNearest = 0.2; // share of the distance, from the eye to a corner
    const double scale = between(0, kMost * placement.scale, [&](double trial) {
        return is_small(corners_at(trial).second, options.fill, kNearest * options.distance);
    });
    auto [filled, corners] = corners_at(scale);
    glm::dvec3 aside(0.0); // in the eye's frame
    for (int axis = 0; axis < 2; ++axis)
        aside[axis] =
            to_middle(corners, axis) / static_cast<double>(view.clip_from_eye[axis][axis]);
    filled.translation += glm::transpose(glm::dmat3(eye_from_room)) * aside;
    return filled;
}

interaction::DataFrame data_frame(const index::SeriesInfo& info) {
    const auto cells = info.grid.cells();
    const glm::dmat4 index_from_box =
        glm::scale(glm::dmat4(1.0), glm::dvec3(cells[0], cells[1], cells[2]));
    interaction::DataFrame frame{info.grid.physical_from_index() * index_from_box,
                                 info.length_unit,
                                 {cells[0], cells[1], cells[2]}};
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (!info.grid.positions[axis].even())
            frame.distances[axis] = &info.grid.positions[axis].distances();
    return frame;
}

} // namespace isochron::app
