// Planes that hands move.
#include "interaction/tools/plane_hold.h"

#include "index/volume/box_cut.h"
#include "interaction/navigation/navigation.h"

#define GLM_ENABLE_EXPERIMENTAL
#include <glm/geometric.hpp>
#include <glm/gtx/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace isochron::interaction {
namespace {

/// Share of the box: the mouse can pull the plane this far outside it.
constexpr double kBeside = 0.05;
constexpr double kFaces = 0.12; ///< squared sine below which a plane faces the user: 20 degrees
constexpr double kAlong = 0.02; ///< squared sine below which a ray runs along the normal
constexpr double kRim = 0.85; ///< share of the outline, from its middle, outside which it is turned

/// Distance along a line, from `at`, to its point that is nearest to a ray; none if the ray runs
/// nearly along the line.
std::optional<double> nearest_along(const glm::dvec3& at, const glm::dvec3& direction,
                                    const Pose& ray) {
    const glm::dvec3 way = ahead_of(ray), between = glm::dvec3(ray.position) - at;
    const double cosine = glm::dot(direction, way), sine2 = 1 - cosine * cosine;
    if (sine2 < kAlong)
        return std::nullopt;
    return (glm::dot(between, direction) - cosine * glm::dot(between, way)) / sine2;
}

/// The place where the ray runs along the line, as towards a plane that faces the user: dragging up
/// moves the plane away, as far as the cursor moves on it. @param before the ray that met `at`
double moved_along(const glm::dvec3& at, const glm::dvec3& direction, const Pose& before,
                   const Pose& ray) {
    const glm::dvec3 way = ahead_of(before);
    const glm::dvec3 above =
        glm::abs(way.y) < 0.99
            ? glm::dvec3(0, 1, 0)
            : glm::normalize(glm::dquat(before.orientation)) * glm::dvec3(0, 1, 0);
    const glm::dvec3 up = glm::normalize(above - glm::dot(above, way) * way);
    const double away = glm::dot(at - glm::dvec3(before.position), way);
    const glm::dvec3 now = ahead_of(ray);
    const glm::dvec3 there = glm::dvec3(ray.position) + away / glm::dot(now, way) * now;
    const double pushed = glm::dot(there - at, up);
    return glm::dot(direction, way) > 0 ? pushed : -pushed;
}

/// The middle of a plane's outline, in the room, if a point of the plane is near to the outline.
std::optional<glm::dvec3> middle_for_rim(const glm::dvec3& at, const Plane& plane,
                                         const ToolContext& now) {
    std::vector<glm::dvec3> corners = outline(plane, now.session.data);
    if (corners.empty())
        return std::nullopt;
    glm::dvec3 middle(0.0);
    for (glm::dvec3& corner : corners) {
        corner = transform(now.room_from_physical, corner);
        middle += corner / static_cast<double>(corners.size());
    }
    const glm::dvec3 normal = normal_in_room(now.room_from_physical, plane.normal);
    double share = 0; // how far the point is on the way from the middle to the outline
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3& from = corners[i];
        const glm::dvec3 side = glm::cross(corners[(i + 1) % corners.size()] - from, normal);
        const double whole = glm::dot(middle - from, side);
        if (whole != 0)
            share = std::max(share, 1 - glm::dot(at - from, side) / whole);
    }
    return share > kRim ? std::optional(middle) : std::nullopt;
}

/// The way from a sphere's middle to where a ray meets the sphere first, or comes nearest to it.
glm::dvec3 on_sphere(const glm::dvec3& middle, double radius, const Pose& ray) {
    const glm::dvec3 way = ahead_of(ray), to = middle - glm::dvec3(ray.position);
    const double along = glm::dot(to, way);
    const glm::dvec3 beside = along * way - to;
    const double within = radius * radius - glm::dot(beside, beside);
    return within > 0 ? beside - std::sqrt(within) * way : beside;
}

/// The rotation that takes one direction to another one the shortest way.
glm::dquat turn_between(const glm::dvec3& from, const glm::dvec3& to) {
    return glm::rotation(glm::normalize(from), glm::normalize(to));
}

} // namespace

glm::dvec3 ahead_of(const Pose& ray) {
    return glm::normalize(glm::dquat(ray.orientation)) * glm::dvec3(0, 0, -1);
}

glm::dvec3 across(int axis, const DataFrame& data) {
    const glm::dmat4& box = data.physical_from_box;
    return glm::normalize(
        glm::cross(glm::dvec3(box[(axis + 1) % 3]), glm::dvec3(box[(axis + 2) % 3])));
}

std::optional<int> axis_across(const glm::dvec3& normal, const DataFrame& data) {
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(glm::dot(normal, across(axis, data))) > 1 - 1e-9)
            return axis;
    return std::nullopt;
}

std::optional<PlaneMeeting> meeting_of(const Pose& ray, const Plane& plane,
                                       const ToolContext& now) {
    const Similarity& room = now.room_from_physical;
    const glm::dvec3 from(ray.position), way = ahead_of(ray);
    const glm::dvec3 normal = normal_in_room(room, plane.normal);
    const double rate = glm::dot(way, normal);
    if (rate == 0)
        return std::nullopt;
    const double along = glm::dot(transform(room, plane.point) - from, normal) / rate;
    if (!(along > 0))
        return std::nullopt;
    const glm::dvec3 at = from + along * way;
    const glm::dvec3 in_box = now.session.data.in_box(in_physical(room, at));
    for (int axis = 0; axis < 3; ++axis)
        if (!(in_box[axis] >= -kBeside && in_box[axis] <= 1 + kBeside))
            return std::nullopt;
    return PlaneMeeting{at, along};
}

Plane PlaneHold::moved_with(const ToolHand& hand, const Plane& plane, const ToolContext& now) {
    if (hand.pressed)
        held_ = Held{*hand.ray, plane};
    if (!held_)
        return plane;
    const Similarity& room = now.room_from_physical;
    // Treats the plane as a thing in the room that the hand carries.
    const Similarity before{transform(room, held_->plane.point), {1, 0, 0, 0}, 1.0};
    const Similarity after = carried(before, held_->hand, *hand.ray);
    return {in_physical(room, after.translation),
            glm::normalize(normal_in_physical(
                room, after.rotation * normal_in_room(room, held_->plane.normal)))};
}

Plane PlaneHold::turned_with(const ToolHand& hand, const ToolContext& now) const {
    const Similarity& room = now.room_from_physical;
    const glm::dvec3 &middle = *pulled_->about, arm = pulled_->at - middle;
    const double radius = glm::length(arm);
    // From where the ray was, so that the plane does not jump as the button goes down.
    const glm::dquat turn =
        turn_between(on_sphere(middle, radius, pulled_->ray), on_sphere(middle, radius, *hand.ray));
    const glm::dvec3 point = transform(room, pulled_->plane.point);
    return {in_physical(room, middle + turn * (point - middle)),
            glm::normalize(normal_in_physical(room, turn * pulled_->normal))};
}

Plane PlaneHold::pulled_with(const ToolHand& hand, const Plane& plane, const ToolContext& now,
                             bool turns) {
    const Similarity& room = now.room_from_physical;
    if (hand.pressed) {
        const auto met = meeting_of(*hand.ray, plane, now);
        pulled_.reset();
        if (met)
            pulled_ = Pulled{plane, *hand.ray, met->at, normal_in_room(room, plane.normal),
                             turns ? middle_for_rim(met->at, plane, now) : std::nullopt};
    }
    if (!pulled_)
        return plane;
    if (pulled_->about)
        return turned_with(hand, now);
    const double cosine = glm::dot(pulled_->normal, ahead_of(pulled_->ray));
    const auto along = 1 - cosine * cosine < kFaces
                           ? moved_along(pulled_->at, pulled_->normal, pulled_->ray, *hand.ray)
                           : nearest_along(pulled_->at, pulled_->normal, *hand.ray);
    if (!along)
        return plane;
    Plane pulled = pulled_->plane;
    pulled.point += (*along * physical_per_meter(room, pulled.normal)) * pulled.normal;
    return pulled;
}

Plane PlaneHold::update(std::span<const ToolHand> hands, const Plane& plane, const ToolContext& now,
                        bool turns) {
    Plane after = plane;
    bool holds = false, pulls = false;
    for (const ToolHand& hand : hands) {
        if (!hand.ray || !hand.down)
            continue;
        if (hand.is_mouse) {
            pulls = true;
            after = pulled_with(hand, after, now, turns);
        } else if (!holds) {
            holds = true;
            after = moved_with(hand, after, now);
        }
    }
    if (!holds)
        held_.reset();
    if (!pulls)
        pulled_.reset();
    return after;
}

std::vector<glm::dvec3> outline(const Plane& plane, const DataFrame& data) {
    std::vector<glm::dvec3> corners =
        index::edges_cut(glm::dvec3(1.0), [&](const glm::dvec3& in_box) {
            return glm::dot(data.at(in_box) - plane.point, plane.normal);
        });
    for (glm::dvec3& corner : corners)
        corner = data.at(corner);
    return index::in_order(std::move(corners), plane.normal);
}

std::vector<ToolLine> outline_lines(const Plane& plane, const DataFrame& data,
                                    const glm::vec4& color) {
    const std::vector<glm::dvec3> corners = outline(plane, data);
    std::vector<ToolLine> lines;
    for (std::size_t i = 0; i < corners.size(); ++i)
        lines.push_back({corners[i], corners[(i + 1) % corners.size()], color});
    return lines;
}

} // namespace isochron::interaction
