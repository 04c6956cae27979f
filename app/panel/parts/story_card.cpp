// The card of a story.
#include "app/panel/parts/story_card.h"

#include "app/panel/panel_words.h"
#include "app/panel/parts/theme.h"
#include "interaction/navigation/story.h"

#include <imgui.h>

#include <algorithm>
#include <string>

namespace isochron::app {
namespace {

using interaction::Commands;

constexpr float kWideCard = 360.0f,
                kNarrowCard = 250.0f;          ///< its width lies between them
constexpr float kOverAxes = 118.0f;            ///< the axes and the scale bar stay free
constexpr float kEdge = 12.0f, kAtEdge = 4.0f; ///< beside and below the card
constexpr float kFrame = 76.0f;                ///< height of the card without its text
constexpr float kFewLines = 60.0f; ///< height of a text; with less, the card stands at the edge
constexpr float kCardShare = 0.4f; ///< share of the picture's height that a text has at most

/// @param highest that the text may be, panel pixels
void text_and_buttons(const PanelModel& model, float highest, Commands& commands) {
    const interaction::Settings& asked = model.asked;
    const interaction::StoryStep step = interaction::story_step(asked.keys, asked.story);
    ImGui::PushID("story");
    note(interaction::story_heading(asked.keys, asked.story), color_of(Ink::accent));
    const std::string& words = asked.keys[asked.story - 1].text;
    const float width = ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ScrollbarSize;
    const float height = ImGui::CalcTextSize(words.c_str(), nullptr, false, width).y;
    ImGui::BeginChild("text", {0.0f, std::min(height, highest) + 4.0f});
    note(words, color_of(Ink::text));
    ImGui::EndChild();
    const auto button = [&](const char* label, std::uint32_t to, const char* effect) {
        ImGui::BeginDisabled(to == 0);
        if (ImGui::Button(label))
            commands.story = to;
        ImGui::EndDisabled();
        tip(effect);
        ImGui::SameLine();
    };
    button("Previous", step.previous, "the step before (Ctrl + Page Up)");
    button("Next", step.next, "the next step (Ctrl + Page Down)");
    const char* const leave = "Leave";
    const float wide = ImGui::CalcTextSize(leave).x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::SameLine(ImGui::GetContentRegionMax().x - wide);
    if (ImGui::Button(leave))
        commands.story = 0;
    tip("leave the story (Escape)");
    ImGui::PopID();
}

/// From the nearest place of a card's edge to where its text is about.
void line_to_place(const ImVec2& low, const ImVec2& high, const ImVec2& place) {
    const ImVec2 from{std::clamp(place.x, low.x, high.x), std::clamp(place.y, low.y, high.y)};
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddLine(from, place, packed(Ink::bar), 4.0f);
    list.AddLine(from, place, packed(Ink::accent), 2.0f);
}

/// The card's width.
float width_in(const PanelBox& picture) {
    return std::min(std::clamp(0.45f * picture.size().x, kNarrowCard, kWideCard),
                    picture.size().x - 2 * kEdge);
}

} // namespace

float story_card_end(const PanelModel& model, const PanelBox& picture) {
    return interaction::told_key(model.asked) ? picture.low.x + kEdge + width_in(picture)
                                              : picture.low.x;
}

bool story_card(const PanelModel& model, const PanelBox& picture, float lowest,
                Commands& commands) {
    if (!interaction::told_key(model.asked))
        return false;
    // A low picture has no room for the axes below the card.
    const float above_axes = picture.high.y - std::min(kOverAxes, 0.16f * picture.size().y);
    const float bottom =
        above_axes - lowest < kFrame + kFewLines ? picture.high.y - kAtEdge : above_axes;
    const float highest =
        std::min(kCardShare * picture.size().y, bottom - lowest - kAtEdge - kFrame);
    ImGui::SetNextWindowPos({picture.low.x + kEdge, bottom}, ImGuiCond_Always, {0.0f, 1.0f});
    ImGui::SetNextWindowSize({width_in(picture), 0.0f});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, color_of(Ink::bar));
    ImGui::Begin("###story", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoSavedSettings);
    text_and_buttons(model, std::max(highest, ImGui::GetTextLineHeight()), commands);
    const ImVec2 low = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    ImGui::End();
    ImGui::PopStyleColor();
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    if (model.told_at)
        line_to_place(low, {low.x + size.x, low.y + size.y},
                      {model.told_at->x * screen.x, model.told_at->y * screen.y});
    return true;
}

void story_rows(const PanelModel& model, Commands& commands) {
    if (!interaction::told_key(model.asked))
        return;
    constexpr float kRows = 90.0f;
    text_and_buttons(model, kRows, commands);
    ImGui::Separator();
}

} // namespace isochron::app
