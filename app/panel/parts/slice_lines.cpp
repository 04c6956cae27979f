// The slices in numbers and buttons.
#include "app/panel/parts/slice_lines.h"

#include "app/panel/panel_words.h"
#include "app/panel/parts/icons.h"
#include "app/panel/parts/plane_fields.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/theme.h"
#include "interaction/tools/slice_tool.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace isochron::app {
namespace {

using interaction::Slices;

/// A button for each slice, which picks it, and one that adds another.
void slice_buttons(const PanelModel& model, Slices& slices) {
    for (std::uint32_t i = 0; slices.planes.size() > 1 && i < slices.planes.size(); ++i) {
        ImGui::SameLine();
        ImGui::PushID(static_cast<int>(i));
        const bool picked = i == slices.picked;
        if (picked)
            ImGui::PushStyleColor(ImGuiCol_Button, color_of(Ink::chosen));
        if (ImGui::Button(fmt::format("{}", i + 1).c_str(), {24.0f, 0.0f}))
            slices.picked = i;
        if (picked)
            ImGui::PopStyleColor();
        tip("the slice that is moved");
        ImGui::PopID();
    }
    if (slices.planes.size() < interaction::kMostSlices) {
        ImGui::SameLine();
        if (icon_button("add slice", Icon::add, "one more slice (Ctrl + Shift + 6)", false,
                        ImGui::GetFrameHeight()))
            slices = with_slice(slices, model.data);
    }
}

} // namespace

void slice_lines(const PanelModel& model, interaction::Commands& commands) {
    constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
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
        slice_buttons(model, slices);
        ImGui::SameLine();
        if (icon_button("no slice", Icon::remove, "remove this slice (Delete: all)", false, side))
            slices = without_slice(slices);
        ImGui::SameLine(0.0f, 14.0f);
        tick_field("##isolines", slices.isolines, "isolines");
        tip("the isovalues of the surfaces as lines on the slices");
        ImGui::SameLine(0.0f, 14.0f);
        tick_field("##alone", slices.alone, "alone");
        tip("hide the surfaces (Ctrl + H)");
    }
    if (slices.picked < slices.planes.size()) {
        for (const bool forward : {false, true}) {
            if (ImGui::ArrowButton(forward ? "forward" : "back",
                                   forward ? ImGuiDir_Right : ImGuiDir_Left))
                slices = stepped(slices, forward, model.data);
            tip(forward ? "one cell along the normal (Ctrl + Up)" : "one cell back (Ctrl + Down)");
            ImGui::SameLine();
        }
        plane_fields(model, slices.planes[slices.picked], "the slice's normal");
    }
    ImGui::PopID();
    if (slices != model.asked.slices)
        commands.slices = slices;
}

} // namespace isochron::app
