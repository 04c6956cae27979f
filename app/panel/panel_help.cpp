// The help page on the connected devices, and the four lines of introduction.
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

bool help_window(const PanelModel& model) {
    const ImVec2 picture = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({picture.x / 2, picture.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize(
        {std::min(std::floor(0.96f * picture.x), 620.0f), 2 * std::floor(0.46f * picture.y)});
    bool open = true;
    ImGui::Begin("Keys, mouse and devices (F1)###help", &open,
                 ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                     ImGuiWindowFlags_NoSavedSettings);
    ImGui::BeginChild("controls"); // its lines end above the window's rounded edge
    ImGui::Indent(4.0f);           // letters reach beyond their own place
    controls_of(model.at_hand, model.controls);
    ImGui::EndChild();
    ImGui::End();
    return open;
}

void first_use_window(const PanelBox& picture) {
    ImGui::SetNextWindowPos({(picture.low.x + picture.high.x) / 2, picture.high.y - 14.0f},
                            ImGuiCond_Always, {0.5f, 1.0f});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, color_of(Ink::bar));
    ImGui::Begin("###first use", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                     ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing |
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings);
    ImGui::PushTextWrapPos(std::min(480.0f, 0.94f * picture.size().x));
    for (const char* line :
         {"Drag with the left button to turn the data; the wheel scales them.",
          "Up and Down change the isovalue, or drag its line in the histogram.",
          "Space plays the steps; Left and Right go through them.",
          "Ctrl + K finds every command, F1 lists all keys. This hint disappears "
          "when you begin."})
        ImGui::TextUnformatted(line);
    ImGui::PopTextWrapPos();
    ImGui::End();
    ImGui::PopStyleColor();
}

} // namespace isochron::app
