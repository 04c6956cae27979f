// The slices in numbers and buttons.
#include "app/panel/parts/slice_lines.h"

#include "app/config/first_placement.h"
#include "app/panel/panel_words.h"
#include "app/panel/parts/icons.h"
#include "app/panel/parts/plane_fields.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/theme.h"
#include "interaction/navigation/axis_views.h"
#include "interaction/tools/slice_tool.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace isochron::app {
namespace {

using interaction::Slices;

/// A button for each slice, which picks it, and one that adds another.
void slice_buttons(const PanelModel& model, float right, Slices& slices) {
    constexpr float kWidth = 24.0f;
    for (std::uint32_t i = 0; slices.planes.size() > 1 && i < slices.planes.size(); ++i) {
        go_on_within(right, kWidth);
        ImGui::PushID(static_cast<int>(i));
        const bool picked = i == slices.picked;
        if (picked)
            ImGui::PushStyleColor(ImGuiCol_Button, color_of(Ink::chosen));
        if (ImGui::Button(fmt::format("{}", i + 1).c_str(), {kWidth, 0.0f}))
            slices.picked = i;
        if (picked)
            ImGui::PopStyleColor();
        tip("the slice that is moved");
        ImGui::PopID();
    }
    if (slices.planes.size() < interaction::kMostSlices) {
        go_on_within(right, ImGui::GetFrameHeight());
        if (icon_button("add slice", Icon::add, "one more slice (Ctrl + Shift + 6)", false,
                        ImGui::GetFrameHeight()))
            slices = with_slice(slices, model.data);
    }
}

} // namespace

interaction::Commands flat_view(const PanelModel& model, Slices slices) {
    interaction::Commands commands;
    const interaction::Similarity& room = model.asked.room_from_physical;
    const interaction::Plane plane = slices.planes.at(slices.picked);
    const glm::dvec3 viewer = in_physical(room, glm::dvec3(model.head.position));
    const bool from_front = glm::dot(viewer - plane.point, plane.normal) >= 0;
    constexpr double kUpright = 0.9; // cosine to z beyond which y points up
    const glm::dvec3 up =
        std::abs(plane.normal.z) > kUpright ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    const interaction::AxisView view{"flat", from_front ? plane.normal : -plane.normal, up};
    commands.room_from_physical =
        seen_from(view, room, physical_center(model.info.grid), model.head);
    slices.alone = true;
    commands.slices = std::move(slices);
    if (model.place != PanelPlace::in_room)
        commands.orthographic = true;
    return commands;
}

void slice_lines(const PanelModel& model, float width, interaction::Commands& commands) {
    constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
    constexpr float kGap = 14.0f;
    const float right = ImGui::GetCursorScreenPos().x + width;
    Slices slices = model.asked.slices;
    ImGui::PushID("slices");
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(color_of(Ink::dim), "slice across");
    for (int axis = 0; axis < 3; ++axis) {
        ImGui::SameLine();
        ImGui::PushID(axis);
        if (ImGui::Button(kAxes[static_cast<std::size_t>(axis)], {26.0f, 0.0f}))
            slices = snapped(slices, axis, model.data);
        tip("slice at right angles to this axis (Ctrl + 6: the next axis)");
        ImGui::PopID();
    }
    if (slices.shown()) {
        const float side = ImGui::GetFrameHeight();
        slice_buttons(model, right, slices);
        go_on_within(right, side);
        if (icon_button("no slice", Icon::remove, "remove this slice (Delete: all)", false, side))
            slices = without_slice(slices);
        go_on_within(right, tick_width("isolines"), kGap);
        tick_field("##isolines", slices.isolines, "isolines");
        tip("the isovalues of the surfaces as lines on the slices");
        go_on_within(right, tick_width("alone"), kGap);
        tick_field("##alone", slices.alone, "alone");
        tip("hide the surfaces (Ctrl + H)");
        go_on_within(right, button_width("flat"), kGap);
        if (ImGui::Button("flat"))
            merge(commands, flat_view(model, slices));
        tip("look straight at the slice, alone and in parallel projection");
    }
    if (slices.picked < slices.planes.size()) {
        for (const bool forward : {false, true}) {
            if (ImGui::ArrowButton(forward ? "forward" : "back",
                                   forward ? ImGuiDir_Right : ImGuiDir_Left))
                slices = stepped(slices, forward, model.data);
            tip(forward ? "one cell along the normal (Ctrl + Up)" : "one cell back (Ctrl + Down)");
            ImGui::SameLine();
        }
        plane_fields(model, slices.planes[slices.picked], right, "the slice's normal");
    }
    ImGui::PopID();
    if (slices != model.asked.slices)
        commands.slices = slices;
}

} // namespace isochron::app
