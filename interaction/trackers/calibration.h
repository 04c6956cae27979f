// Calibration: from the poses that a tracker reports to poses in the room.
#pragma once

#include "interaction/pose.h"

#include <glm/mat3x3.hpp>

#include <optional>

namespace isochron::interaction {

/// room = room_from_tracker * (scale * sensor) * sensor_from_thing. The thing is what the device is
/// named after: the point between the eyes for `head`, the hand for `wand`. Only positions are
/// scaled.
struct Calibration {
    Pose room_from_tracker; ///< the tracker's origin and axes in the room
    double scale = 1.0;     ///< meters per meter that the tracker reports
    Pose sensor_from_thing; ///< the thing in the sensor's own frame [m]
    bool operator==(const Calibration&) const = default;
};

/// Pose of the thing in the room.
/// @param sensor pose of the sensor in the tracker's frame, as reported [m]
Pose calibrated(const Calibration& calibration, const Pose& sensor);

/// Velocity of the thing in the room: the arm between sensor and thing turns with the sensor.
/// @param thing its pose in the room
/// @param sensor velocity of the sensor in the tracker's frame, as reported [m/s, rad/s]
Velocity calibrated(const Calibration& calibration, const Pose& thing, const Velocity& sensor);

/// Y(heading) * X(pitch) * Z(roll), angles in [rad], counter-clockwise as seen against each axis: a
/// positive heading turns to the left, a positive pitch looks up.
glm::quat rotation_from_angles(const glm::vec3& heading_pitch_roll);

/// The rotation of a matrix whose column i is the image of axis i; empty if the matrix is not
/// finite or mirrors, or if its columns are not nearly orthogonal and of unit length.
std::optional<glm::quat> rotation_from(const glm::dmat3& axes);

/// The pose after the time `ahead`, at constant velocity.
Pose extrapolated(const Pose& pose, const Velocity& velocity, Seconds ahead);

} // namespace isochron::interaction
