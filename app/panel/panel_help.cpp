// The help page on the connected devices.
#include "app/panel/panel_help.h"

#include "app/panel/panel_words.h"
#include "app/panel/parts/theme.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace isochron::app {
namespace {

/// A table with two columns, made from lines of a control, spaces, and its effect.
void table_of(const interaction::ControlGroup& group) {
    if (!ImGui::BeginTable(words_of(group.device).data(), 2))
        return;
    ImGui::TableSetupColumn("control", ImGuiTableColumnFlags_WidthStretch, 0.36f);
    ImGui::TableSetupColumn("effect", ImGuiTableColumnFlags_WidthStretch, 0.64f);
    for (const std::string& line : group.lines) {
        const std::size_t end = line.find("  ");
        const std::size_t effect = line.find_first_not_of(' ', end);
        ImGui::TableNextColumn();
        note(line.substr(0, end), ImGui::GetStyleColorVec4(ImGuiCol_Text));
        ImGui::TableNextColumn();
        if (effect != std::string::npos)
            note(line.substr(effect), color_of(Ink::dim));
    }
    ImGui::EndTable();
}

} // namespace

void controls_of(std::span<const interaction::DeviceKind> kinds,
                 std::span<const interaction::ControlGroup> groups) {
    for (const interaction::ControlGroup& group : groups) {
        if (std::ranges::find(kinds, group.device) == kinds.end())
            continue;
        if (kinds.size() > 1)
            text(std::string(words_of(group.device)));
        table_of(group);
        ImGui::Separator();
    }
}

HelpAnswer help_window(const PanelModel& model) {
    const ImVec2 picture = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({picture.x / 2, picture.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize(
        {std::min(std::floor(0.96f * picture.x), 620.0f), 2 * std::floor(0.46f * picture.y)});
    bool open = true;
    ImGui::Begin("Keys, mouse and devices (F1)###help", &open,
                 ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                     ImGuiWindowFlags_NoSavedSettings);
    const bool tour = model.place == PanelPlace::over && ImGui::Button("Take the tour: six steps");
    note("Ctrl + K finds any of this by its words, and does it.", color_of(Ink::dim));
    ImGui::BeginChild("controls"); // its lines end above the window's rounded edge
    ImGui::Indent(4.0f);           // letters reach beyond their own place
    controls_of(model.at_hand, model.controls);
    ImGui::EndChild();
    ImGui::End();
    return {open && !tour, tour};
}

} // namespace isochron::app
