// Moving the volume in the room: pure functions from one similarity to the next.
#pragma once

#include "interaction/pose.h"

#include <optional>
#include <span>

namespace isochron::interaction {

/// Physical point `p` in the room.
glm::dvec3 transform(const Similarity& similarity, const glm::dvec3& p);
/// The physical point that is at `p` in the room.
glm::dvec3 in_physical(const Similarity& similarity, const glm::dvec3& p);
/// Unit normal, in the room, of a plane whose physical unit normal is `normal`; and the other way.
glm::dvec3 normal_in_room(const Similarity& similarity, const glm::dvec3& normal);
glm::dvec3 normal_in_physical(const Similarity& similarity, const glm::dvec3& normal);
/// How far a plane moves along its physical unit normal if it moves 1 m along its normal in the
/// room.
double physical_per_meter(const Similarity& similarity, const glm::dvec3& normal);

/// Turned by `angle` [rad] about the room line through `center` along the unit vector `axis`.
Similarity turned(const Similarity& from, const glm::dvec3& center, const glm::dvec3& axis,
                  double angle);

/// Moved by `offset` [m].
Similarity moved(const Similarity& from, const glm::dvec3& offset);

/// Moved so that places of the data are before the viewer: their middle straight ahead, as far as it
/// was, or farther so that all of them are in sight. Where their middle is in sight nothing moves.
/// @param places in physical space, one at least
Similarity brought_into_view(const Similarity& from, std::span<const glm::dvec3> places,
                             const Pose& viewer);

/// Scaled by `factor` about the room point `center`; the scale stays within [low, high], and a
/// factor that is not a positive number changes nothing.
Similarity scaled(const Similarity& from, const glm::dvec3& center, double factor, double low,
                  double high);

inline constexpr double kScaleRange = 1e3; ///< largest factor between the scale and `home`'s

inline constexpr double kLeastExaggeration = 0.01, kMostExaggeration = 1000;

/// With heights exaggerated by `exaggeration`, within the limits above; the physical point `center`
/// stays where it is.
Similarity exaggerated(const Similarity& from, const glm::dvec3& center, double exaggeration);

/// Carried along rigidly by a hand that went from pose `before` to pose `after`.
Similarity carried(const Similarity& from, const Pose& before, const Pose& after);

/// Two points of the room that hold on to the volume.
struct Span {
    glm::dvec3 a, b;
    glm::dvec3 middle() const { return (a + b) / 2.0; }
    glm::dvec3 direction() const { return b - a; }
};
/// The smallest rotation that turns the direction of `from` into the direction of `to`; the
/// identity if either span is at most 1 cm long.
glm::dquat rotation_onto(const Span& from, const Span& to);
/// Turned by `turn`, scaled by the ratio of the spans' lengths, and moved with the span's middle.
/// The scale stays within [low, high]; spans shorter than 1 cm count as 1 cm.
Similarity stretched(const Similarity& from, const Span& before, const Span& after,
                     const glm::dquat& turn, double low, double high);

/// Where the ray of a pose meets the floor (y = 0 in the room), within `reach` [m] of it.
std::optional<glm::dvec3> floor_point(const Pose& pose, double reach);

/// Heading of a pose [rad], counter-clockwise from ahead (-Z) as seen from above.
double heading(const Pose& pose);

/// Whether every component is finite, the scale positive and the exaggeration within its limits.
bool is_valid(const Similarity& similarity);

} // namespace isochron::interaction
