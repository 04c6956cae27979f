// What a newcomer is offered: a hint, and a tour of six steps that can be left at any point; and
// the offer to go on with the session before.
#include "app/panel/parts/tour.h"

#include "app/panel/imgui/number_entry.h"
#include "app/panel/panel_words.h"
#include "app/panel/parts/messages.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/session_field.h"
#include "app/panel/parts/theme.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>

namespace isochron::app {
namespace {

struct TourStep {
    const char *name, *words;
    bool (*is_done)(const ExplorerState& before, const ExplorerState& now);
};

constexpr std::array<TourStep, Tour::kSteps> kTour{{
    {"Isovalue",
     "The surface passes through all places with one value, the isovalue. Drag the line in the "
     "histogram under Surfaces at the left, or press Up and Down.",
     [](const ExplorerState& before, const ExplorerState& now) {
         return before.isovalue() != now.isovalue();
     }},
    {"Time",
     "The bar at the bottom is time. Press Space to play, Left and Right for single steps, or "
     "click on the track.",
     [](const ExplorerState& before, const ExplorerState& now) {
         return before.instant != now.instant;
     }},
    {"Turn",
     "Drag in the picture with the left button to turn the data, with the middle one, or Shift and "
     "the left, to move them; the wheel scales them. The cube at the upper right shows how they "
     "lie: click on a face of it.",
     [](const ExplorerState& before, const ExplorerState& now) {
         return before.room_from_physical != now.room_from_physical;
     }},
    {"Pick",
     "Click on the surface: the mark says where that is, and the value there. Ctrl + C copies it.",
     [](const ExplorerState& before, const ExplorerState& now) {
         return now.mark.point && before.mark != now.mark;
     }},
    {"Clip",
     "Press 7 for a plane that cuts the surface open; again for the next axis. The line at the top "
     "moves it by number. Delete removes it.",
     [](const ExplorerState& before, const ExplorerState& now) {
         return now.clip.shown && before.clip != now.clip;
     }},
    {"Save",
     "P saves a picture, Ctrl + S the session; the session is also saved when you leave. Ctrl + K "
     "finds every command by its words.",
     [](const ExplorerState&, const ExplorerState&) { return false; }},
}};

/// Begins a card at a place in the picture. @param pivot part of the card that lies there
void begin_card(const char* id, const PanelBox& picture, float width, float top, float pivot) {
    width = std::min(width, 0.96f * picture.size().x);
    const float middle = (picture.low.x + picture.high.x) / 2;
    ImGui::SetNextWindowPos({middle, top}, ImGuiCond_Always, {0.5f, pivot});
    ImGui::SetNextWindowSize({width, 0.0f});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, color_of(Ink::bar));
    ImGui::Begin(id, nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoSavedSettings);
}

void end_card() {
    ImGui::End();
    ImGui::PopStyleColor();
}

Answer answer_of(const char* yes, const char* no) {
    if (ImGui::Button(yes))
        return Answer::yes;
    ImGui::SameLine();
    return ImGui::Button(no) ? Answer::no : Answer::none;
}

constexpr float kAboveScaleBar = 62.0f; ///< the scale bar, and the words below it, stay free

constexpr float kLow = 420.0f; ///< picture of which all lines of a card would hide a third

} // namespace

Answer hint_card(const PanelBox& picture, bool& held) {
    begin_card(kHintCard, picture, 500.0f, picture.high.y - kAboveScaleBar, 1.0f);
    constexpr std::array<const char*, 4> kLines{
        "Drag with the left button to turn the data; the wheel scales them.",
        "Up and Down change the isovalue, or drag its line in the histogram.",
        "Space plays the steps; Left and Right go through them.",
        "Ctrl + K finds every command, F1 lists all keys."};
    for (const char* line : kLines)
        if (picture.size().y >= kLow || line == kLines.front() || line == kLines.back())
            note(line, color_of(Ink::text));
    const Answer answer = answer_of("Take the tour: six steps", "No, thanks");
    held = ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
    end_card();
    return answer;
}

bool has_room_for(const char* card, const PanelBox& picture, float lowest) {
    const ImGuiWindow* const window = ImGui::FindWindowByName(card);
    return !window || picture.high.y - kAboveScaleBar - window->Size.y >= lowest;
}

bool room_card(const PanelBox& picture) {
    begin_card(kRoomCard, picture, 620.0f, picture.high.y - kAboveScaleBar, 1.0f);
    constexpr std::array<const char*, 4> kLines{
        "You look at the room from outside; each wall shows what its viewer's left eye sees.",
        "Hold C: drag to circle round the room, middle drag to move it, wheel to come nearer.",
        "Right drag turns the viewer's head, W A S D walk, left drag turns the data.",
        "The lines lead from each viewer to the corners of what that viewer sees."};
    for (const char* line : kLines)
        if (picture.size().y >= kLow || line != kLines.front())
            note(line, color_of(Ink::text));
    const bool read = ImGui::Button("I see (Enter)");
    end_card();
    return read;
}

Answer earlier_card(const PanelBox& picture, std::span<const OfferedSession> earlier,
                    std::size_t& chosen) {
    dim_rest();
    begin_card("###earlier", picture, 360.0f, (picture.low.y + picture.high.y) / 2, 0.5f);
    bring_forward();
    small_picture(earlier.front().picture);
    ImGui::SameLine();
    ImGui::BeginGroup();
    note("These data were explored before.", color_of(Ink::text));
    note(earlier.front().words, color_of(Ink::dim));
    ImGui::EndGroup();
    Answer answer = answer_of("Continue where you left off", "Start anew");
    note("Enter continues, Escape starts anew.", color_of(Ink::dim));
    if (earlier.size() > 1) {
        ImGui::SetNextItemWidth(-1.0f);
        if (const auto other = session_field("##earlier sessions",
                                             fmt::format("{} sessions", earlier.size()), earlier)) {
            chosen = *other;
            answer = Answer::yes;
        }
    }
    end_card();
    return answer;
}

Answer name_card(const PanelBox& picture, float top, std::string& name) {
    begin_card("###session name", picture, 360.0f, top, 0.0f);
    note("The session is saved. A name keeps it for ever.", color_of(Ink::text));
    if (!ImGui::IsAnyItemActive()) { // it has the keyboard as long as the question is open
        ImGui::SetWindowFocus();
        ImGui::SetKeyboardFocusHere();
    }
    ImGui::SetNextItemWidth(-1.0f);
    text_field("##name", "name of this session", name);
    const bool entered = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter));
    const Answer answer = answer_of("Name it", "No name");
    end_card();
    return answer == Answer::none && entered ? Answer::yes : answer;
}

void Tour::draw(const PanelModel& model, const PanelBox& picture) {
    if (!step_)
        return;
    if (before_of_ != step_) {
        before_of_ = step_;
        before_ = model.asked;
        done_ = false;
    }
    const TourStep& step = kTour[*step_];
    done_ = done_ || step.is_done(before_, model.asked);
    begin_card(kTourCard, picture, 420.0f, picture.high.y - kAboveScaleBar, 1.0f);
    ImGui::TextColored(color_of(Ink::dim), "%s",
                       fmt::format("{} of {}", *step_ + 1, kSteps).c_str());
    ImGui::SameLine();
    text(step.name);
    if (done_) {
        ImGui::SameLine();
        ImGui::TextColored(color_of(Ink::good), "done");
    }
    note(step.words, color_of(Ink::text));
    const bool last = *step_ + 1 == kSteps;
    ImGui::BeginDisabled(*step_ == 0);
    const bool back = ImGui::Button("Back");
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (done_)
        ImGui::PushStyleColor(ImGuiCol_Button, color_of(Ink::chosen));
    const bool next = ImGui::Button(last ? "Finish" : "Next");
    if (done_)
        ImGui::PopStyleColor();
    const char* const leave = "Leave the tour";
    const float width = ImGui::CalcTextSize(leave).x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::SameLine(ImGui::GetContentRegionMax().x - width);
    const bool left = ImGui::Button(leave);
    end_card();
    if (left || (next && last))
        step_.reset();
    else if (next)
        ++*step_;
    else if (back && *step_ > 0)
        --*step_;
}

} // namespace isochron::app
