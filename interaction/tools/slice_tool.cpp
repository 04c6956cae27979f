// Slices: laying, moving and outlining them.
#include "interaction/tools/slice_tool.h"

#include "interaction/navigation/navigation.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochron::interaction {
namespace {

constexpr glm::vec4 kSliceColor(0.45f, 0.72f, 0.95f, 0.75f),
    kPickedSlice(0.62f, 0.85f, 1.0f, 0.95f);

glm::dvec3 middle_of(const DataFrame& data) {
    return data.at({0.5, 0.5, 0.5});
}

/// The data's axis that is nearest to a direction in the room.
int axis_along(const glm::dvec3& ahead, const ToolContext& now) {
    int nearest = 0;
    double most = -1;
    for (int axis = 0; axis < 3; ++axis) {
        const glm::dvec3 normal =
            normal_in_room(now.room_from_physical, across(axis, now.session.data));
        if (const double cosine = std::abs(glm::dot(normal, ahead)); cosine > most) {
            most = cosine;
            nearest = axis;
        }
    }
    return nearest;
}

Slices laid(Slices slices, const Pose& ray, const ToolContext& now) {
    const auto found = now.session.find_surface ? now.session.find_surface(ray) : std::nullopt;
    const DataFrame& data = now.session.data;
    if (slices.planes.size() == kMostSlices) // all of them hidden
        slices.planes.pop_back();
    slices.planes.push_back({found ? found->point.position : middle_of(data),
                             across(axis_along(ahead_of(ray), now), data)});
    slices.picked = static_cast<std::uint32_t>(slices.planes.size()) - 1;
    return slices;
}

/// The slice that a ray meets first; nothing: it meets none.
std::optional<std::uint32_t> slice_met(const Slices& slices, const Pose& ray,
                                       const ToolContext& now) {
    std::optional<std::uint32_t> first;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < slices.planes.size(); ++i) {
        if (!slices.planes[i].shown)
            continue;
        if (const auto met = meeting_of(ray, slices.planes[i], now); met && met->along < nearest) {
            nearest = met->along;
            first = static_cast<std::uint32_t>(i);
        }
    }
    return first;
}

} // namespace

ToolOutcome SliceTool::update(std::span<const ToolHand> hands, const ToolContext& now) {
    ToolOutcome outcome;
    const Slices& slices = now.session.settings.slices;
    if (!slices.seen()) {
        hold_.let_go();
        for (const ToolHand& hand : hands)
            if (hand.ray && hand.chosen)
                outcome.commands.slices = laid(slices, *hand.ray, now);
        return outcome;
    }
    Slices after = slices;
    after.picked = std::min(after.picked, static_cast<std::uint32_t>(after.planes.size()) - 1);
    for (const ToolHand& hand : hands)
        if (hand.ray && hand.pressed)
            after.picked = slice_met(slices, *hand.ray, now).value_or(after.picked);
    Plane& plane = after.planes[after.picked];
    if (!plane.shown)
        hold_.let_go();
    const Plane moved = plane.shown ? hold_.update(hands, plane, now) : plane;
    if (!outline(moved, now.session.data).empty()) // else it would be lost
        plane = moved;
    if (after != slices)
        outcome.commands.slices = after;
    return outcome;
}

Slices with_slice(Slices slices, const DataFrame& data) {
    if (slices.planes.size() >= kMostSlices)
        return slices;
    int axis = 2;
    for (const int other : {2, 1, 0}) {
        const bool taken = std::ranges::any_of(slices.planes, [&](const Plane& plane) {
            return axis_across(plane.normal, data) == other;
        });
        if (!taken) {
            axis = other;
            break;
        }
    }
    slices.planes.push_back({middle_of(data), across(axis, data)});
    slices.picked = static_cast<std::uint32_t>(slices.planes.size()) - 1;
    return slices;
}

Slices without_slice(Slices slices) {
    if (slices.picked < slices.planes.size())
        slices.planes.erase(slices.planes.begin() + slices.picked);
    slices.picked = slices.picked > 0 ? slices.picked - 1 : 0;
    return slices;
}

Slices snapped(Slices slices, int axis, const DataFrame& data) {
    if (slices.planes.empty())
        slices.planes.push_back({middle_of(data), {}});
    slices.picked = std::min(slices.picked, static_cast<std::uint32_t>(slices.planes.size()) - 1);
    slices.planes[slices.picked].normal = across(axis, data);
    slices.planes[slices.picked].shown = true;
    return slices;
}

Slices snapped_next(const Slices& slices, const DataFrame& data) {
    if (slices.picked >= slices.planes.size())
        return with_slice(slices, data);
    const auto axis = axis_across(slices.planes[slices.picked].normal, data);
    return snapped(slices, axis ? (*axis + 1) % 3 : 0, data);
}

Slices stepped(Slices slices, bool forward, const DataFrame& data) {
    if (slices.picked >= slices.planes.size())
        return slices;
    Plane& plane = slices.planes[slices.picked];
    Plane moved = plane;
    constexpr double kOnVertex = 1e-6; // cells
    if (const auto axis = axis_across(plane.normal, data)) {
        const bool up = forward == (glm::dot(plane.normal, across(*axis, data)) > 0);
        glm::dvec3 in_box = data.in_box(plane.point);
        const double at = data.index_along(*axis, in_box[*axis]);
        const double next = up ? std::floor(at + kOnVertex) + 1 : std::ceil(at - kOnVertex) - 1;
        in_box[*axis] = data.share_along(*axis, std::clamp(next, 0.0, data.cells[*axis]));
        moved.point = data.at(in_box);
    } else {
        double most = 0;
        for (int i = 0; i < 3; ++i)
            most = std::max(
                most, std::abs(glm::dot(plane.normal, glm::dvec3(data.physical_from_box[i]))) /
                          data.cells[i]);
        moved.point += (forward ? most : -most) * plane.normal;
        if (outline(moved, data).empty())
            return slices;
    }
    plane = moved;
    return slices;
}

ToolDrawing draw_slices(const Settings& settings, const DataFrame& data) {
    ToolDrawing drawing;
    const Slices& slices = settings.slices;
    for (std::size_t i = 0; i < slices.planes.size(); ++i) {
        if (!slices.planes[i].shown)
            continue;
        const bool picked = i == slices.picked && slices.planes.size() > 1;
        const auto lines =
            outline_lines(slices.planes[i], data, picked ? kPickedSlice : kSliceColor);
        drawing.lines.insert(drawing.lines.end(), lines.begin(), lines.end());
    }
    return drawing;
}

} // namespace isochron::interaction
