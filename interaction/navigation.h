// Moving the volume in the room: pure functions from one similarity to the next.
#pragma once

#include "interaction/pose.h"

namespace isochron::interaction {

/// Physical point `p` in the room.
glm::dvec3 transform(const Similarity& similarity, const glm::dvec3& p);

/// Turned by `angle` [rad] about the room line through `centre` along the unit vector `axis`.
Similarity turned(const Similarity& from, const glm::dvec3& centre, const glm::dvec3& axis,
                  double angle);

/// Moved by `offset` [m].
Similarity moved(const Similarity& from, const glm::dvec3& offset);

/// Scaled by `factor` about the room point `centre`; the scale stays within [low, high], and a
/// factor that is not a positive number changes nothing.
Similarity scaled(const Similarity& from, const glm::dvec3& centre, double factor, double low,
                  double high);

/// Carried along rigidly by a hand that went from pose `before` to pose `after`.
Similarity carried(const Similarity& from, const Pose& before, const Pose& after);

/// Whether every component is finite and the scale positive.
bool is_valid(const Similarity& similarity);

} // namespace isochron::interaction
