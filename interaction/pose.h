// Positions and orientations in the room, and the clock of a session.
#pragma once

#include <chrono>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace isochron::interaction {

/// Session time: 0 at the start of a session or recording.
using Seconds = std::chrono::duration<double>;

/// Rigid pose in the room frame (OpenXR STAGE): right-handed, +Y up, -Z forward, meters.
struct Pose {
    glm::vec3 position{0.0f};
    glm::quat orientation{1.0f, 0.0f, 0.0f, 0.0f}; ///< unit; files store x y z w
    bool operator==(const Pose&) const = default;
};

/// Velocity in the room: linear [m/s] and angular [rad/s, along the axis of turning].
struct Velocity {
    glm::dvec3 linear{0.0}, angular{0.0};
    bool operator==(const Velocity&) const = default;
};

/// 4x4 matrix that maps the posed thing's own space to the room.
glm::mat4 room_from(const Pose& pose);
bool is_finite(const Pose& pose);
bool is_finite(const Velocity& velocity);
/// Rotation vector [rad], at most pi long, that turns `from` into `to`, in the room.
glm::dvec3 rotation_between(const glm::quat& from, const glm::quat& to);

/// Where the data stands in the room: room = translation + scale * rotation * physical. It is a
/// similarity of data whose heights (physical z) are exaggerated before.
struct Similarity {
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    double scale = 1.0;        ///< > 0, finite
    double exaggeration = 1.0; ///< factor of physical z: 0.01 to 1000
    bool operator==(const Similarity&) const = default;
};
glm::dmat4 matrix(const Similarity& similarity);

} // namespace isochron::interaction
