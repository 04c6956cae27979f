// Matrices of poses and similarities.
#include "interaction/pose.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace isochron::interaction {

glm::mat4 room_from(const Pose& pose) {
    return glm::translate(glm::mat4(1.0f), pose.position) * glm::mat4_cast(pose.orientation);
}

glm::dmat4 matrix(const Similarity& similarity) {
    return glm::translate(glm::dmat4(1.0), similarity.translation) *
           glm::mat4_cast(similarity.rotation) *
           glm::scale(glm::dmat4(1.0),
                      similarity.scale * glm::dvec3(1, 1, similarity.exaggeration));
}

bool is_finite(const Pose& pose) {
    const glm::vec3& p = pose.position;
    const glm::quat& q = pose.orientation;
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && std::isfinite(q.x) &&
           std::isfinite(q.y) && std::isfinite(q.z) && std::isfinite(q.w);
}

bool is_finite(const Velocity& velocity) {
    for (const glm::dvec3& v : {velocity.linear, velocity.angular})
        if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
            return false;
    return true;
}

glm::dvec3 rotation_between(const glm::quat& from, const glm::quat& to) {
    glm::dquat turn = glm::dquat(to) * glm::conjugate(glm::dquat(from));
    if (turn.w < 0)
        turn = -turn;
    const glm::dvec3 axis(turn.x, turn.y, turn.z);
    const double sine = glm::length(axis);
    return sine > 0 ? axis * (2.0 * std::atan2(sine, turn.w) / sine) : glm::dvec3(0);
}

} // namespace isochron::interaction
