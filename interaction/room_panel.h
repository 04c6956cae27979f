// The panel that stands in the room: where it is put, and where a ray meets it.
#pragma once

#include "interaction/commands.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <optional>

namespace isochron::interaction {

/// [m]
struct PanelSize {
    float width = 0.46f, height = 0.62f;
    bool operator==(const PanelSize&) const = default;
};

/// Where a ray meets a panel's plane.
struct PanelHit {
    glm::vec2 at{
        0.0f}; ///< fractions of width and height from the top left, beyond 0 to 1 beside it
    float distance = 0; ///< [m] along the ray
    bool inside() const { return at.x >= 0 && at.x <= 1 && at.y >= 0 && at.y <= 1; }
};

/// @param ray starts at its position and goes along its -Z
/// @return nothing where the plane is behind the ray's start, or seen from the back or edge-on
std::optional<PanelHit> hit_of(const Pose& ray, const Pose& panel, const PanelSize& size);

/// Its place: the inverse of `hit_of`.
glm::vec3 place_on(const Pose& panel, const PanelSize& size, const glm::vec2& at);

/// Lower left, upper left, upper right, lower right.
std::array<glm::vec3, 4> corners_of(const Pose& panel, const PanelSize& size);

/// A panel about `middle` whose face is turned to `eyes`, its edges level.
Pose facing(const glm::vec3& middle, const glm::vec3& eyes);

/// Before a viewer, whichever way the head is nodded or rolled: its middle so far below eye level
/// that eyes rest on it.
/// @param distance [m] from the eyes
Pose ahead_of(const Pose& head, float distance);
/// Likewise to the left of the way ahead, where it does not stand before the data.
Pose beside(const Pose& head, float distance);

/// What calling for the panel leads to: it comes to where it can be read, or goes if it is there.
/// @param distance [m] from the eyes at which it stands beside the way ahead
/// @param place in the head's frame where it stands instead
RoomPanel called(const RoomPanel& panel, const Pose& head, float distance,
                 const std::optional<Pose>& place = {});

} // namespace isochron::interaction
