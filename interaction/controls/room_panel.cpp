// Geometry of the panel that stands in the room.
#include "interaction/controls/room_panel.h"

#include "interaction/navigation/navigation.h"

#include <cmath>

namespace isochron::interaction {
namespace {

constexpr float kAside =
    0.42f;                     ///< [rad] to the left of the heading, so that the data stay in sight
constexpr float kGaze = 0.26f; ///< [rad] below the horizon, where eyes rest: 15 degrees
constexpr float kEdgeOn = 0.05f; ///< cosine to the normal; below it the panel counts as edge-on
constexpr float kInSight = 0.7f; ///< cosine to where it appears; above it the panel is in sight
constexpr float kInReach = 2.0f; ///< times the distance at which it appears; within it is in reach
constexpr glm::vec3 kRoomUp(0.0f, 1.0f, 0.0f);

} // namespace

std::optional<PanelHit> hit_of(const Pose& ray, const Pose& panel, const PanelSize& size) {
    const glm::quat into = glm::conjugate(glm::normalize(panel.orientation));
    const glm::vec3 start = into * (ray.position - panel.position);
    const glm::vec3 way = into * (glm::normalize(ray.orientation) * glm::vec3(0, 0, -1));
    if (!(start.z > 0.0f) || !(way.z < -kEdgeOn))
        return std::nullopt;
    const float distance = -start.z / way.z;
    const glm::vec3 on = start + distance * way;
    return PanelHit{{0.5f + on.x / size.width, 0.5f - on.y / size.height}, distance};
}

glm::vec3 place_on(const Pose& panel, const PanelSize& size, const glm::vec2& at) {
    return panel.position + panel.orientation * glm::vec3((at.x - 0.5f) * size.width,
                                                          (0.5f - at.y) * size.height, 0.0f);
}

std::array<glm::vec3, 4> corners_of(const Pose& panel, const PanelSize& size) {
    return {place_on(panel, size, {0, 1}), place_on(panel, size, {0, 0}),
            place_on(panel, size, {1, 0}), place_on(panel, size, {1, 1})};
}

Pose facing(const glm::vec3& middle, const glm::vec3& eyes) {
    const glm::vec3 towards = eyes - middle, across = glm::cross(kRoomUp, towards);
    if (!(glm::length(across) > 1e-4f)) // right above or below the eyes: no edge can be level
        return {middle, glm::quat(1.0f, 0.0f, 0.0f, 0.0f)};
    const glm::vec3 z = glm::normalize(towards), x = glm::normalize(across);
    return {middle, glm::normalize(glm::quat_cast(glm::mat3(x, glm::cross(z, x), z)))};
}

Pose ahead_of(const Pose& head, float distance) {
    const glm::quat turn = glm::angleAxis(static_cast<float>(heading(head)), kRoomUp);
    const glm::vec3 way = turn * glm::vec3(0.0f, -std::sin(kGaze), -std::cos(kGaze));
    return facing(head.position + distance * way, head.position);
}

Pose beside(const Pose& head, float distance) {
    const glm::vec3 ahead = ahead_of(head, distance).position - head.position;
    return facing(head.position + glm::angleAxis(kAside, kRoomUp) * ahead, head.position);
}

RoomPanel called(const RoomPanel& panel, const Pose& head, float distance,
                 const std::optional<Pose>& place) {
    if (!is_finite(head))
        return panel;
    const Pose next = place ? Pose{head.position + head.orientation * place->position,
                                   glm::normalize(head.orientation * place->orientation)}
                            : beside(head, distance);
    const glm::vec3 to_panel = panel.pose.position - head.position;
    const float away = glm::length(to_panel);
    // A panel is in sight if it is ahead, or near the place where it would appear.
    const glm::vec3 ahead = ahead_of(head, 1.0f).position - head.position;
    const glm::vec3 there = glm::normalize(next.position - head.position);
    const bool in_sight = away > 0.0f && (glm::dot(to_panel, ahead) > kInSight * away ||
                                          (place && glm::dot(to_panel, there) > kInSight * away));
    const bool reads = glm::dot(panel.pose.orientation * glm::vec3(0, 0, 1), to_panel) < 0.0f;
    if (panel.shown && in_sight && reads && away < kInReach * distance)
        return {false, panel.pose};
    return {true, next};
}

} // namespace isochron::interaction
