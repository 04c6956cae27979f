// The panel that stands in the room: where it is put, and where a ray meets it.
#pragma once

#include "interaction/commands.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <optional>

namespace isochron::interaction {

/// Width and height of the panel [m].
struct PanelSize {
    float width = 0.46f, height = 0.62f;
    bool operator==(const PanelSize&) const = default;
};

/// Where a ray meets a panel's plane.
struct PanelHit {
    glm::vec2 at{
        0.0f}; ///< fractions of width and height from the top left; outside 0 to 1: off the panel
    float distance = 0; ///< [m] along the ray
    bool inside() const { return at.x >= 0 && at.x <= 1 && at.y >= 0 && at.y <= 1; }
};

/// @param ray starts at its position and goes along its -Z
/// @return nothing where the plane is behind the ray's start, or seen from the back or edge-on
std::optional<PanelHit> hit_of(const Pose& ray, const Pose& panel, const PanelSize& size);

/// The point in the room of a place `at` on a panel, as in `PanelHit`.
glm::vec3 place_on(const Pose& panel, const PanelSize& size, const glm::vec2& at);

/// Lower left, upper left, upper right, lower right.
std::array<glm::vec3, 4> corners_of(const Pose& panel, const PanelSize& size);

/// Pose of a panel with its middle at `middle` that faces `eyes`, its top and bottom edges level.
Pose facing(const glm::vec3& middle, const glm::vec3& eyes);

/// A panel ahead of a viewer, 15 degrees below eye level where eyes rest. Only the head's position
/// and heading count.
/// @param distance [m] from the eyes
Pose ahead_of(const Pose& head, float distance);
/// A place ahead, but to the left, so that it does not hide the data.
Pose beside(const Pose& head, float distance);

/// The panel after its button was pressed: hidden if it was in sight and in reach, otherwise shown
/// where it can be read.
/// @param distance [m] from the eyes, if it is shown to the left (`beside`)
/// @param place pose in the head's frame at which it is shown instead
RoomPanel called(const RoomPanel& panel, const Pose& head, float distance,
                 const std::optional<Pose>& place = {});

} // namespace isochron::interaction
