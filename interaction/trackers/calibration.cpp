// Calibration: from the poses that a tracker reports to poses in the room.
#include "interaction/trackers/calibration.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace isochron::interaction {
namespace {

/// Tolerance of the dot products of a rotation's columns; trackers send few decimals.
constexpr double kNearlyOrthogonal = 0.02;

} // namespace

Pose calibrated(const Calibration& calibration, const Pose& sensor) {
    const Pose& room = calibration.room_from_tracker;
    const Pose& thing = calibration.sensor_from_thing;
    const glm::quat sensor_in_room = room.orientation * sensor.orientation;
    const glm::vec3 scaled = static_cast<float>(calibration.scale) * sensor.position;
    return {room.position + room.orientation * scaled + sensor_in_room * thing.position,
            glm::normalize(sensor_in_room * thing.orientation)};
}

Velocity calibrated(const Calibration& calibration, const Pose& thing, const Velocity& sensor) {
    const glm::dquat turn(calibration.room_from_tracker.orientation);
    const glm::quat sensor_in_room =
        thing.orientation * glm::conjugate(calibration.sensor_from_thing.orientation);
    const glm::dvec3 arm(sensor_in_room * calibration.sensor_from_thing.position);
    const glm::dvec3 angular = turn * sensor.angular;
    return {turn * (calibration.scale * sensor.linear) + glm::cross(angular, arm), angular};
}

glm::quat rotation_from_angles(const glm::vec3& heading_pitch_roll) {
    return glm::normalize(glm::angleAxis(heading_pitch_roll.x, glm::vec3(0, 1, 0)) *
                          glm::angleAxis(heading_pitch_roll.y, glm::vec3(1, 0, 0)) *
                          glm::angleAxis(heading_pitch_roll.z, glm::vec3(0, 0, 1)));
}

std::optional<glm::quat> rotation_from(const glm::dmat3& axes) {
    const glm::dmat3 products = glm::transpose(axes) * axes;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) {
            const double expected = row == column ? 1.0 : 0.0;
            if (!(std::abs(products[column][row] - expected) <= kNearlyOrthogonal))
                return std::nullopt;
        }
    if (glm::determinant(axes) < 0)
        return std::nullopt;
    return glm::quat(glm::normalize(glm::quat_cast(axes)));
}

Pose extrapolated(const Pose& pose, const Velocity& velocity, Seconds ahead) {
    const double angle = glm::length(velocity.angular) * ahead.count();
    glm::dquat turned(pose.orientation);
    if (angle != 0)
        turned = glm::angleAxis(angle, glm::normalize(velocity.angular)) * turned;
    return {pose.position + glm::vec3(velocity.linear * ahead.count()),
            glm::quat(glm::normalize(turned))};
}

} // namespace isochron::interaction
