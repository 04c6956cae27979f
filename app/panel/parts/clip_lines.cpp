// The clip plane in numbers: where it lies along its normal, and the normal itself.
#include "app/panel/parts/clip_lines.h"

#include "app/panel/panel_words.h"
#include "app/panel/parts/icons.h"
#include "app/panel/parts/plane_fields.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/theme.h"
#include "interaction/tools/clip_box.h"
#include "interaction/tools/clip_tool.h"

#include <glm/vector_relational.hpp>
#include <imgui.h>

#include <array>
#include <cstddef>

namespace isochron::app {
namespace {

using interaction::ClipPlane;
using interaction::Commands;

/// The box's ends along each axis, as indices of vertices, while it is shown.
void box_fields(const PanelModel& model, float right, Commands& commands) {
    constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
    constexpr float kBefore = 4.0f, kEnd = 54.0f; // the gap before a field, and its width
    interaction::ClipBox box = model.asked.clip_box;
    if (!box.shown)
        return;
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(color_of(Ink::dim), "box");
    for (int axis = 0; axis < 3; ++axis) {
        ImGui::PushID(axis);
        const char* const name = kAxes[static_cast<std::size_t>(axis)];
        go_on_within(right, ImGui::CalcTextSize(name).x + 2 * (kBefore + kEnd));
        ImGui::AlignTextToFramePadding();
        ImGui::TextColored(color_of(Ink::dim), "%s", name);
        const FieldRange range{.low = 0, .high = model.data.cells[axis]};
        for (const bool high : {false, true}) {
            double& end = high ? box.high[axis] : box.low[axis];
            ImGui::SameLine(0.0f, kBefore);
            ImGui::SetNextItemWidth(kEnd);
            number_field(high ? "##high" : "##low", end, range, "%.4g");
            tip("an end of the box, as the index of a vertex (--crop of commands counts so): drag, "
                "or click and type");
        }
        ImGui::PopID();
    }
    if (box != model.asked.clip_box && glm::all(glm::lessThan(box.low, box.high)))
        commands.clip_box = box;
}

} // namespace

void clip_lines(const PanelModel& model, float width, Commands& commands) {
    const float right = ImGui::GetCursorScreenPos().x + width;
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
    go_on_within(right, tick_width("box"));
    bool boxed = model.asked.clip_box.shown;
    if (tick_field("##box", boxed, "box"))
        commands.clip_box = boxed ? interaction::whole_box(model.data) : interaction::ClipBox{};
    tip("a box along the data's axes outside which all is cut away: drag its faces");
    if (!model.asked.clip.shown) {
        box_fields(model, right, commands);
        return;
    }
    const float side = ImGui::GetFrameHeight();
    go_on_within(right, side);
    if (icon_button("flip", Icon::flip, "cut away the other side (Ctrl + 7)", false, side))
        commands.clip = interaction::flipped(model.asked.clip);
    go_on_within(right, side);
    if (icon_button("no clip", Icon::remove, "remove the clip plane (Delete)", false, side))
        commands.clip = ClipPlane{};
    const ClipPlane& now = model.asked.clip;
    interaction::Plane plane{now.point, now.normal};
    plane_fields(model, plane, right, "the plane's normal: it points to the side that is cut away");
    if (plane != interaction::Plane{now.point, now.normal})
        commands.clip = {true, plane.point, plane.normal};
    box_fields(model, right, commands);
}

} // namespace isochron::app
