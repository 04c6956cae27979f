// The clip plane in numbers: where it lies along its normal, and the normal itself.
#include "app/panel/parts/clip_lines.h"

#include "app/panel/panel_words.h"
#include "app/panel/parts/icons.h"
#include "app/panel/parts/plane_fields.h"
#include "app/panel/parts/theme.h"
#include "interaction/tools/clip_tool.h"

#include <imgui.h>

#include <array>
#include <cstddef>

namespace isochron::app {
namespace {

using interaction::ClipPlane;
using interaction::Commands;

} // namespace

void clip_lines(const PanelModel& model, Commands& commands) {
    constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(color_of(Ink::dim), "clip across");
    for (int axis = 0; axis < 3; ++axis) {
        ImGui::SameLine();
        ImGui::PushID(axis);
        if (ImGui::Button(kAxes[static_cast<std::size_t>(axis)], {26.0f, 0.0f}))
            commands.clip = snapped(model.asked.clip, axis, model.data);
        tip("clip plane at right angles to this axis (7: the next axis); again: the other side is "
            "cut away (Ctrl + 7)");
        ImGui::PopID();
    }
    if (!model.asked.clip.shown)
        return;
    const float side = ImGui::GetFrameHeight();
    ImGui::SameLine();
    if (icon_button("flip", Icon::flip, "cut away the other side (Ctrl + 7)", false, side))
        commands.clip = interaction::flipped(model.asked.clip);
    ImGui::SameLine();
    if (icon_button("no clip", Icon::remove, "remove the clip plane (Delete)", false, side))
        commands.clip = ClipPlane{};
    const ClipPlane& now = model.asked.clip;
    interaction::Plane plane{now.point, now.normal};
    plane_fields(model, plane, "the plane's normal: it points to the side that is cut away");
    if (plane != interaction::Plane{now.point, now.normal})
        commands.clip = {true, plane.point, plane.normal};
}

} // namespace isochron::app
