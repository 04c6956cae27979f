// Moving the volume in the room.
#include "interaction/navigation/navigation.h"

#include <glm/gtx/quaternion.hpp>

#include <algorithm>
#include <cmath>

namespace isochron::interaction {
namespace {

constexpr double kShortestSpan = 0.01; ///< [m] between hands; a shorter span tells no direction

} // namespace

glm::dvec3 transform(const Similarity& similarity, const glm::dvec3& p) {
    return similarity.translation +
           similarity.scale *
               (similarity.rotation * glm::dvec3(p.x, p.y, similarity.exaggeration * p.z));
}

glm::dvec3 in_physical(const Similarity& similarity, const glm::dvec3& p) {
    glm::dvec3 at =
        glm::conjugate(similarity.rotation) * (p - similarity.translation) / similarity.scale;
    at.z /= similarity.exaggeration;
    return at;
}

glm::dvec3 normal_in_room(const Similarity& similarity, const glm::dvec3& normal) {
    glm::dvec3 n = normal;
    if (similarity.exaggeration != 1) {
        n.z /= similarity.exaggeration;
        n = glm::normalize(n);
    }
    return similarity.rotation * n;
}

glm::dvec3 normal_in_physical(const Similarity& similarity, const glm::dvec3& normal) {
    glm::dvec3 n = glm::conjugate(similarity.rotation) * normal;
    if (similarity.exaggeration != 1) {
        n.z *= similarity.exaggeration;
        n = glm::normalize(n);
    }
    return n;
}

double physical_per_meter(const Similarity& similarity, const glm::dvec3& normal) {
    if (similarity.exaggeration == 1)
        return 1 / similarity.scale;
    return glm::length(glm::dvec3(normal.x, normal.y, normal.z / similarity.exaggeration)) /
           similarity.scale;
}

Similarity exaggerated(const Similarity& from, const glm::dvec3& center, double exaggeration) {
    Similarity result = from;
    if (exaggeration > 0)
        result.exaggeration = std::clamp(exaggeration, kLeastExaggeration, kMostExaggeration);
    result.translation += transform(from, center) - transform(result, center);
    return result;
}

Similarity turned(const Similarity& from, const glm::dvec3& center, const glm::dvec3& axis,
                  double angle) {
    const glm::dquat turn = glm::angleAxis(angle, axis);
    return {center + turn * (from.translation - center), glm::normalize(turn * from.rotation),
            from.scale, from.exaggeration};
}

Similarity moved(const Similarity& from, const glm::dvec3& offset) {
    return {from.translation + offset, from.rotation, from.scale, from.exaggeration};
}

Similarity brought_into_view(const Similarity& from, std::span<const glm::dvec3> places,
                             const Pose& viewer) {
    constexpr double kInSight = 0.35; // [rad] off the way ahead
    glm::dvec3 low = transform(from, places[0]), high = low;
    for (const glm::dvec3& place : places) {
        low = glm::min(low, transform(from, place));
        high = glm::max(high, transform(from, place));
    }
    const glm::dvec3 middle = (low + high) / 2.0, eye(viewer.position);
    const glm::dvec3 ahead = glm::normalize(glm::dquat(viewer.orientation)) * glm::dvec3(0, 0, -1);
    const double radius = glm::distance(low, high) / 2, away = glm::distance(middle, eye);
    if (away >= radius && glm::dot(middle - eye, ahead) >= std::cos(kInSight) * away)
        return from;
    return moved(from, eye + std::max(away, radius / std::sin(kInSight)) * ahead - middle);
}

Similarity scaled(const Similarity& from, const glm::dvec3& center, double factor, double low,
                  double high) {
    if (!(factor > 0.0) || !(low <= high))
        return from;
    const double scale = std::clamp(from.scale * factor, low, high);
    const double applied = scale / from.scale;
    return {center + applied * (from.translation - center), from.rotation, scale,
            from.exaggeration};
}

Similarity carried(const Similarity& from, const Pose& before, const Pose& after) {
    const glm::dquat turn = glm::normalize(glm::dquat(after.orientation)) *
                            glm::conjugate(glm::normalize(glm::dquat(before.orientation)));
    const glm::dvec3 offset = from.translation - glm::dvec3(before.position);
    return {glm::dvec3(after.position) + turn * offset, glm::normalize(turn * from.rotation),
            from.scale, from.exaggeration};
}

glm::dquat rotation_onto(const Span& from, const Span& to) {
    const double from_length = glm::length(from.direction());
    const double to_length = glm::length(to.direction());
    if (!(from_length > kShortestSpan) || !(to_length > kShortestSpan))
        return {1, 0, 0, 0};
    return glm::rotation(from.direction() / from_length, to.direction() / to_length);
}

Similarity stretched(const Similarity& from, const Span& before, const Span& after,
                     const glm::dquat& turn, double low, double high) {
    const double growth = std::max(glm::length(after.direction()), kShortestSpan) /
                          std::max(glm::length(before.direction()), kShortestSpan);
    const Similarity grown = scaled(from, before.middle(), growth, low, high);
    return {after.middle() + turn * (grown.translation - before.middle()),
            glm::normalize(turn * grown.rotation), grown.scale, grown.exaggeration};
}

std::optional<glm::dvec3> floor_point(const Pose& pose, double reach) {
    const glm::dvec3 from(pose.position);
    const glm::dvec3 ahead = glm::normalize(glm::dquat(pose.orientation)) * glm::dvec3(0, 0, -1);
    if (!(from.y > 0) || !(ahead.y < 0))
        return std::nullopt;
    const double distance = from.y / -ahead.y;
    return distance <= reach ? std::optional(from + distance * ahead) : std::nullopt;
}

double heading(const Pose& pose) {
    const glm::dvec3 back = glm::normalize(glm::dquat(pose.orientation)) * glm::dvec3(0, 0, 1);
    return std::atan2(back.x, back.z);
}

bool is_valid(const Similarity& similarity) {
    const glm::dvec3& t = similarity.translation;
    const glm::dquat& r = similarity.rotation;
    for (const double value : {t.x, t.y, t.z, r.x, r.y, r.z, r.w, similarity.scale})
        if (!std::isfinite(value))
            return false;
    return similarity.scale > 0.0 && similarity.exaggeration >= kLeastExaggeration &&
           similarity.exaggeration <= kMostExaggeration;
}

} // namespace isochron::interaction
