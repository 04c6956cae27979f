// The clip plane: placing, moving and drawing it.
#include "interaction/tools/clip_tool.h"

#include "interaction/navigation/navigation.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace isochron::interaction {
namespace {

constexpr glm::vec4 kClipColor(1.0f, 0.62f, 0.32f, 0.95f);
/// Share of the box: the mouse can pull the plane this far outside it.
constexpr double kBeside = 0.05;
constexpr double kFaces = 0.12; ///< squared sine below which a plane faces the user: 20 degrees
constexpr double kAlong = 0.02; ///< squared sine below which a ray runs along the normal

glm::dvec3 ahead_of(const Pose& ray) {
    return glm::normalize(glm::dquat(ray.orientation)) * glm::dvec3(0, 0, -1);
}

/// The point in the room where a ray meets the plane within the data's box or just outside it.
std::optional<glm::dvec3> met(const Pose& ray, const ClipPlane& plane, const ToolContext& now) {
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
    return at;
}

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

/// Unit normal of the faces at the two ends of one axis of the box.
glm::dvec3 across(int axis, const DataFrame& data) {
    const glm::dmat4& box = data.physical_from_box;
    return glm::normalize(
        glm::cross(glm::dvec3(box[(axis + 1) % 3]), glm::dvec3(box[(axis + 2) % 3])));
}

} // namespace

void ClipTool::move_with(const ToolHand& hand, const ToolContext& now, Commands& commands) {
    if (hand.pressed)
        held_ = Held{*hand.ray, now.session.settings.clip};
    if (!held_)
        return;
    const Similarity& room = now.room_from_physical;
    // Treats the plane as a thing in the room that the hand carries.
    const Similarity before{transform(room, held_->plane.point), {1, 0, 0, 0}, 1.0};
    const Similarity after = carried(before, held_->hand, *hand.ray);
    ClipPlane plane = held_->plane;
    plane.point = in_physical(room, after.translation);
    plane.normal = glm::normalize(
        normal_in_physical(room, after.rotation * normal_in_room(room, held_->plane.normal)));
    if (plane != now.session.settings.clip)
        commands.clip = plane;
}

void ClipTool::pull_with(const ToolHand& hand, const ToolContext& now, Commands& commands) {
    const Similarity& room = now.room_from_physical;
    const ClipPlane& shown = now.session.settings.clip;
    if (hand.pressed) {
        const auto at = met(*hand.ray, shown, now);
        pulled_.reset();
        if (at)
            pulled_ = Pulled{shown, *hand.ray, *at, normal_in_room(room, shown.normal)};
    }
    if (!pulled_)
        return;
    const double cosine = glm::dot(pulled_->normal, ahead_of(pulled_->ray));
    const auto along = 1 - cosine * cosine < kFaces
                           ? moved_along(pulled_->at, pulled_->normal, pulled_->ray, *hand.ray)
                           : nearest_along(pulled_->at, pulled_->normal, *hand.ray);
    if (!along)
        return;
    ClipPlane plane = pulled_->plane;
    plane.point += (*along * physical_per_meter(room, plane.normal)) * plane.normal;
    if (plane != shown)
        commands.clip = plane;
}

ToolOutcome ClipTool::update(std::span<const ToolHand> hands, const ToolContext& now) {
    ToolOutcome outcome;
    bool holds = false, pulls = false;
    for (const ToolHand& hand : hands) {
        if (!hand.ray)
            continue;
        if (!now.session.settings.clip.shown) {
            const auto found = hand.chosen && now.session.find_surface
                                   ? now.session.find_surface(*hand.ray)
                                   : std::nullopt;
            if (found)
                outcome.commands.clip = laid_through(found->point.position, now.room_from_physical,
                                                     ahead_of(*hand.ray));
            else if (hand.chosen)
                outcome.note = "no surface there to lay the clip plane through";
            continue;
        }
        if (!hand.down)
            continue;
        if (hand.is_mouse) {
            pulls = true;
            pull_with(hand, now, outcome.commands);
        } else if (!holds) {
            holds = true;
            move_with(hand, now, outcome.commands);
        }
    }
    if (!holds)
        held_.reset();
    if (!pulls)
        pulled_.reset();
    return outcome;
}

ClipPlane laid_through(const glm::dvec3& place, const Similarity& room_from_physical,
                       const glm::dvec3& ahead) {
    return {true, place, normal_in_physical(room_from_physical, -glm::normalize(ahead))};
}

ClipPlane snapped(const ClipPlane& plane, int axis, const DataFrame& data) {
    const glm::dvec3 point = plane.shown ? plane.point : data.at({0.5, 0.5, 0.5});
    const glm::dvec3 normal = across(axis, data);
    const bool already = plane.shown && plane.normal == normal;
    return {true, point, already ? -normal : normal};
}

ClipPlane snapped_next(const ClipPlane& plane, const DataFrame& data) {
    int next = 0;
    for (int axis = 0; axis < 3; ++axis)
        if (plane.shown && std::abs(glm::dot(plane.normal, across(axis, data))) > 1 - 1e-9)
            next = (axis + 1) % 3;
    return snapped(plane, next, data);
}

ClipPlane flipped(ClipPlane plane) {
    plane.normal = -plane.normal;
    return plane;
}

std::vector<glm::dvec3> outline(const ClipPlane& plane, const DataFrame& data) {
    std::vector<glm::dvec3> corners;
    // The corners are where the plane crosses the twelve edges of the box.
    for (int axis = 0; axis < 3; ++axis)
        for (int edge = 0; edge < 4; ++edge) {
            glm::dvec3 from(0.0), to;
            from[(axis + 1) % 3] = edge & 1;
            from[(axis + 2) % 3] = edge >> 1;
            to = from;
            to[axis] = 1;
            const glm::dvec3 a = data.at(from), b = data.at(to);
            const double low = glm::dot(a - plane.point, plane.normal);
            const double high = glm::dot(b - plane.point, plane.normal);
            if ((low < 0) != (high < 0))
                corners.push_back(a + low / (low - high) * (b - a));
        }
    if (corners.size() < 3)
        return {};
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& corner : corners)
        middle += corner / static_cast<double>(corners.size());
    const glm::dvec3 right = glm::normalize(corners.front() - middle);
    const glm::dvec3 up = glm::cross(plane.normal, right);
    std::ranges::sort(corners, {}, [&](const glm::dvec3& corner) {
        return std::atan2(glm::dot(corner - middle, up), glm::dot(corner - middle, right));
    });
    return corners;
}

ToolDrawing draw_clip(const Settings& settings, const DataFrame& data) {
    ToolDrawing drawing;
    if (!settings.clip.shown)
        return drawing;
    const std::vector<glm::dvec3> corners = outline(settings.clip, data);
    for (std::size_t i = 0; i < corners.size(); ++i)
        drawing.lines.push_back({corners[i], corners[(i + 1) % corners.size()], kClipColor});
    return drawing;
}

} // namespace isochron::interaction
