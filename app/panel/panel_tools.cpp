// The panel's sections on tools, undo and leaving.
#include "app/panel/panel_tools.h"

#include "app/panel/panel_words.h"
#include "interaction/tools/clip_tool.h"
#include "interaction/tools/tool_table.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::ToolKind;

void step_button(const char* words, const char* effect, const Commands* change,
                 Commands& commands) {
    ImGui::BeginDisabled(!change);
    if (ImGui::Button(words) && change)
        commands = *change;
    ImGui::EndDisabled();
    tip(effect);
}

/// @return whether the user chose another tool
bool tool_choice(const char* hand, ToolKind& tool) {
    const auto& table = interaction::tool_table();
    const ToolKind before = tool;
    ImGui::SetNextItemWidth(-90.0f);
    if (ImGui::BeginCombo(hand, std::string(table[static_cast<std::size_t>(tool)].words).c_str())) {
        for (const interaction::ToolRow& row : table) {
            if (ImGui::Selectable(std::string(row.words).c_str(), row.kind == before))
                tool = row.kind;
            if (ImGui::IsItemHovered())
                ImGui::SetTooltip("%s", std::string(row.effect).c_str());
        }
        ImGui::EndCombo();
    } else {
        tip("tool of the mouse, or of the wand's first button (4, 5, 6)");
    }
    return tool != before;
}

void clip_buttons(const PanelModel& model, Commands& commands) {
    constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) {
        ImGui::PushID(axis);
        if (ImGui::SmallButton(kAxes[static_cast<std::size_t>(axis)]))
            commands.clip = snapped(model.asked.clip, axis, model.data);
        tip("clip plane across this axis; again: the other side (7)");
        ImGui::PopID();
        ImGui::SameLine();
    }
    ImGui::BeginDisabled(!model.asked.clip.shown);
    if (ImGui::SmallButton("no clip plane"))
        commands.clip = interaction::ClipPlane{};
    ImGui::EndDisabled();
    tip("remove the clip plane (Delete)");
}

} // namespace

void mark_steps_at_hand(const PanelModel& model, int last) {
    // The marks may differ from wall to wall, and a single step needs none.
    if (model.place == PanelPlace::in_room || model.work.at_hand_steps.size() < 2)
        return;
    constexpr float kHeight = 3.0f;
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    const float width = (high.x - low.x) / static_cast<float>(last + 1);
    for (const std::uint32_t step : model.work.at_hand_steps) {
        const float left = low.x + width * static_cast<float>(step);
        ImGui::GetWindowDrawList()->AddRectFilled({left, high.y - kHeight}, {left + width, high.y},
                                                  ImGui::GetColorU32(ImGuiCol_PlotHistogram));
    }
}

void history_section(const PanelModel& model, Commands& commands) {
    step_button("Undo", "undo (Ctrl + Z)", model.ways.undo, commands);
    ImGui::SameLine();
    step_button("Redo", "redo (Ctrl + Shift + Z)", model.ways.redo, commands);
}

void tools_section(const PanelModel& model, Commands& commands) {
    interaction::Tools tools = model.asked.tools;
    bool changed = tool_choice("mouse", tools.mouse);
    const auto has = [&](interaction::DeviceKind kind) {
        return std::ranges::find(model.at_hand, kind) != model.at_hand.end();
    };
    if (model.place == PanelPlace::in_room || has(interaction::DeviceKind::hands) ||
        has(interaction::DeviceKind::gamepad)) {
        changed = tool_choice("right hand", tools.wand) || changed;
        changed = tool_choice("left hand", tools.other) || changed;
    }
    if (changed)
        commands.tools = tools;
    clip_buttons(model, commands);
    if (!model.asked.ruler.places.empty()) {
        ImGui::SameLine();
        if (ImGui::SmallButton("no ruler"))
            commands.ruler = interaction::Ruler{};
        tip("remove the ruler (Delete)");
    }
}

std::optional<MovieWish> movie_section(const PanelModel& model) {
    std::optional<MovieWish> wish;
    if (model.movies.progress) {
        ImGui::ProgressBar(*model.movies.progress, {-90.0f, 0.0f});
        ImGui::SameLine();
        if (ImGui::Button("Cancel"))
            wish = MovieWish::give_up;
        tip("stop and delete the movie");
        return wish;
    }
    ImGui::BeginDisabled(!model.movies.recorded);
    if (ImGui::Button("recording so far"))
        wish = MovieWish::recording;
    ImGui::EndDisabled();
    tip(model.movies.recorded
            ? "movie of this session; saved in the screenshot folder"
            : "movie of this session; needs a recording (`isochron explore --record FILE`)");
    ImGui::SameLine();
    ImGui::BeginDisabled(model.asked.known_steps(model.info.steps()) < 2);
    if (ImGui::Button("series, this view"))
        wish = MovieWish::series;
    ImGui::EndDisabled();
    tip("movie of all steps with this view, at the playback speed; saved in the screenshot folder");
    return wish;
}

void message_window(const std::string& standing, const std::string& message) {
    if (standing.empty() && message.empty())
        return;
    const ImVec2 picture = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({picture.x / 2, picture.y - 12.0f}, ImGuiCond_Always, {0.5f, 1.0f});
    ImGui::SetNextWindowBgAlpha(0.86f);
    ImGui::Begin("###message", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                     ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing |
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings);
    ImGui::PushTextWrapPos(0.9f * picture.x);
    for (const std::string& line : {standing, message})
        if (!line.empty())
            ImGui::TextUnformatted(line.c_str());
    ImGui::PopTextWrapPos();
    ImGui::End();
}

void progress_window(const std::string& name, const std::string& line, float fraction) {
    const ImVec2 picture = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({picture.x / 2, picture.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(0.9f * picture.x, 420.0f), 0.0f});
    ImGui::Begin("###progress", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                     ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoSavedSettings);
    text(name);
    ImGui::ProgressBar(fraction, {-1.0f, 0.0f});
    text(line);
    note("Escape: leave", kDim);
    ImGui::End();
}

void leaving_window(const PanelModel& model, Commands& commands) {
    if (!model.asked.leaving)
        return;
    const ImVec2 picture = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({picture.x / 2, picture.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowFocus();
    ImGui::Begin("Leave Isochron?###leaving", nullptr,
                 ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings);
    if (model.recording)
        ImGui::TextUnformatted("The recording ends and is saved.");
    if (model.movies.progress)
        ImGui::TextUnformatted("The movie that is being made is discarded.");
    if (ImGui::Button("Leave (Enter)"))
        commands.quit = true;
    ImGui::SameLine();
    if (ImGui::Button("Stay (Escape)"))
        commands.leaving = false;
    ImGui::End();
}

} // namespace isochron::app
