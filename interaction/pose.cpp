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
           glm::scale(glm::dmat4(1.0), glm::dvec3(similarity.scale));
}

bool is_finite(const Pose& pose) {
    const glm::vec3& p = pose.position;
    const glm::quat& q = pose.orientation;
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && std::isfinite(q.x) &&
           std::isfinite(q.y) && std::isfinite(q.z) && std::isfinite(q.w);
}

} // namespace isochron::interaction
