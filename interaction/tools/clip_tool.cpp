// The clip plane: placing, moving and drawing it.
#include "interaction/tools/clip_tool.h"

#include "interaction/navigation/navigation.h"

#include <glm/geometric.hpp>

namespace isochron::interaction {
namespace {

constexpr glm::vec4 kClipColor(1.0f, 0.62f, 0.32f, 0.95f);

} // namespace

/// The box, if a hand holds one of its faces; else nothing.
std::optional<ClipBox> ClipTool::moved_box(std::span<const ToolHand> hands,
                                           const ToolContext& now) {
    const ClipBox& box = now.session.settings.clip_box;
    bool held = false;
    for (const ToolHand& hand : hands) {
        if (hand.ray && hand.pressed && box.shown)
            face_ = face_met(box, *hand.ray, now);
        held = held || (hand.ray && hand.down);
    }
    if (!held || !box.shown)
        face_.reset();
    if (!face_)
        return std::nullopt;
    const Plane plane = plane_of(*face_, box, now.session.data);
    return with_face(box, *face_, hold_.update(hands, plane, now, false), now.session.data);
}

ToolOutcome ClipTool::update(std::span<const ToolHand> hands, const ToolContext& now) {
    ToolOutcome outcome;
    const ClipPlane& clip = now.session.settings.clip;
    if (const auto box = moved_box(hands, now)) {
        if (*box != now.session.settings.clip_box)
            outcome.commands.clip_box = box;
        return outcome;
    }
    if (clip.shown) {
        const Plane plane{clip.point, clip.normal};
        if (const Plane moved = hold_.update(hands, plane, now); moved != plane)
            outcome.commands.clip = {true, moved.point, moved.normal};
        return outcome;
    }
    hold_.let_go();
    if (now.session.settings.clip_box.shown)
        return outcome; // a click on a face lays no plane
    for (const ToolHand& hand : hands) {
        if (!hand.ray || !hand.chosen)
            continue;
        const auto found =
            now.session.find_surface ? now.session.find_surface(*hand.ray) : std::nullopt;
        if (found)
            outcome.commands.clip =
                laid_through(found->point.position, now.room_from_physical, ahead_of(*hand.ray));
        else
            outcome.note = "no surface there to lay the clip plane through";
    }
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
    const auto now = plane.shown ? axis_across(plane.normal, data) : std::nullopt;
    return snapped(plane, now ? (*now + 1) % 3 : 0, data);
}

ClipPlane flipped(ClipPlane plane) {
    plane.normal = -plane.normal;
    return plane;
}

ToolDrawing draw_clip(const Settings& settings, const DataFrame& data) {
    const ClipPlane& clip = settings.clip;
    ToolDrawing drawing = draw_clip_box(settings, data);
    if (clip.shown)
        for (const ToolLine& line : outline_lines({clip.point, clip.normal}, data, kClipColor))
            drawing.lines.push_back(line);
    return drawing;
}

} // namespace isochron::interaction
