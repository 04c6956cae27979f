// Moving the volume in the room.
#include "interaction/navigation.h"

#include <algorithm>
#include <cmath>

namespace isochron::interaction {

glm::dvec3 transform(const Similarity& similarity, const glm::dvec3& p) {
    return similarity.translation + similarity.scale * (similarity.rotation * p);
}

Similarity turned(const Similarity& from, const glm::dvec3& centre, const glm::dvec3& axis,
                  double angle) {
    const glm::dquat turn = glm::angleAxis(angle, axis);
    return {centre + turn * (from.translation - centre), glm::normalize(turn * from.rotation),
            from.scale};
}

Similarity moved(const Similarity& from, const glm::dvec3& offset) {
    return {from.translation + offset, from.rotation, from.scale};
}

Similarity scaled(const Similarity& from, const glm::dvec3& centre, double factor, double low,
                  double high) {
    if (!(factor > 0.0) || !(low <= high))
        return from;
    const double scale = std::clamp(from.scale * factor, low, high);
    const double applied = scale / from.scale;
    return {centre + applied * (from.translation - centre), from.rotation, scale};
}

Similarity carried(const Similarity& from, const Pose& before, const Pose& after) {
    const glm::dquat turn = glm::normalize(glm::dquat(after.orientation)) *
                            glm::conjugate(glm::normalize(glm::dquat(before.orientation)));
    const glm::dvec3 offset = from.translation - glm::dvec3(before.position);
    return {glm::dvec3(after.position) + turn * offset, glm::normalize(turn * from.rotation),
            from.scale};
}

bool is_valid(const Similarity& similarity) {
    const glm::dvec3& t = similarity.translation;
    const glm::dquat& r = similarity.rotation;
    for (const double value : {t.x, t.y, t.z, r.x, r.y, r.z, r.w, similarity.scale})
        if (!std::isfinite(value))
            return false;
    return similarity.scale > 0.0;
}

} // namespace isochron::interaction
