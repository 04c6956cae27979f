// What lies over the picture: how exact it is, and what the user is told and asked.
#include "app/panel/parts/messages.h"

#include "app/panel/panel_statistics.h"
#include "app/panel/panel_words.h"
#include "app/panel/parts/icons.h"
#include "app/panel/parts/story_card.h"
#include "app/panel/parts/theme.h"
#include "app/panel/parts/time_track.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace isochron::app {
namespace {

using interaction::Commands;

constexpr float kMargin = 10.0f; ///< between the picture's edges and what lies over it
constexpr ImGuiWindowFlags kFixed =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_AlwaysAutoResize;

} // namespace

StateWords state_words(const FrameReport& frame, interaction::QualityMode mode) {
    if (!frame.shown)
        return {"searching", false};
    if (frame.cells == 0 && frame.shown == frame.asked)
        return {"no surface", false};
    const bool fast = mode == interaction::QualityMode::fast;
    const bool whole = frame.coarsest == 0;
    const bool best = frame.footprint == render::kBestFootprint;
    if (best && whole && frame.final && !frame.in_parts)
        return {"exact", true};
    if (best && frame.final)
        return {whole ? "exact" : "exact, coarser cells", whole};
    return {fmt::format("{} {} of {}", fast ? "fast" : "preview",
                        static_cast<int>(frame.footprint) + 1, render::kFootprints),
            false};
}

std::string quality_line(const FrameReport& frame) {
    // Fast mode draws quads in motion and at rest.
    const bool fast = frame.reason == QualityReason::fast_mode;
    std::string line =
        fmt::format("{}: {}", fast ? "fast" : name_of(frame.pace), name_of(frame.footprint));
    if (frame.expected)
        line += fmt::format(", {:.1f} of {:.1f} ms", frame.expected->count(), frame.budget.count());
    if (frame.reason == QualityReason::over_budget && frame.better)
        line +=
            fmt::format(" (the next better way of drawing takes {:.1f} ms)", frame.better->count());
    // The line already tells that the picture moves or fits.
    else if (!fast && frame.reason != QualityReason::moving && frame.reason != QualityReason::fits)
        line += fmt::format(" ({})", name_of(frame.reason));
    return line;
}

glm::vec2 state_chip(const PanelModel& model, const PanelBox& picture, bool& open) {
    const StateWords state = model.notes.empty
                                 ? StateWords{short_words(model.notes.empty->why), false}
                                 : state_words(model.frame, model.asked.quality);
    ImGui::SetNextWindowPos({picture.low.x + kMargin, picture.low.y + kMargin});
    const float height = 26.0f, text = ImGui::CalcTextSize(state.words.c_str()).x;
    const float width = text + 34.0f;
    ImGui::SetNextWindowContentSize(
        {width, height}); // words that grow are whole in their first frame
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0f, 0.0f});
    ImGui::Begin("###chip", nullptr, kFixed | ImGuiWindowFlags_NoBackground);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    if (ImGui::InvisibleButton("state", {width, height}))
        open = !open;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const Ink paper = open ? Ink::chosen : ImGui::IsItemHovered() ? Ink::control : Ink::bar;
    list.AddRectFilled(corner, {corner.x + width, corner.y + height}, packed(paper), 5.0f);
    list.AddCircleFilled({corner.x + 13.0f, corner.y + height / 2}, 4.5f,
                         packed(state.exact ? Ink::good : Ink::warning));
    list.AddText({corner.x + 24.0f, corner.y + (height - ImGui::GetFontSize()) / 2},
                 packed(Ink::text), state.words.c_str());
    tip("how exact the picture is; a click shows the times and numbers behind it");
    ImGui::End();
    ImGui::PopStyleVar();
    // What stands beside the chip stays where it is while a picture that is not small becomes exact.
    constexpr float kSmall = 800.0f;
    const float widest =
        picture.size().x < kSmall ? width : ImGui::CalcTextSize("preview 4 of 4").x + 34.0f;
    return {corner.x + std::max(width, widest), corner.y + height};
}

float statistics_end(const PanelBox& picture) {
    constexpr float kWidth = 380.0f;
    return picture.low.x + std::min(kWidth + kMargin, picture.size().x - kMargin);
}

glm::vec2 statistics_window(const PanelModel& model, const PanelBox& picture, float top,
                            float highest, PanelPages& pages) {
    ImGui::SetNextWindowPos({picture.low.x + kMargin, top});
    const float width = statistics_end(picture) - picture.low.x - kMargin;
    ImGui::SetNextWindowSize({width, 0.0f});
    ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {width, highest});
    ImGui::Begin("###statistics", nullptr,
                 kFixed & ~(ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoScrollbar));
    note(quality_line(model.frame), color_of(Ink::text));
    measurements(model);
    if (!model.notes.past.empty() && ImGui::Button("messages ..."))
        pages.messages = true;
    const ImVec2 corner = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    ImGui::End();
    return {corner.x + size.x, corner.y + size.y};
}

void gap_window(const PanelModel& model, const PanelBox& picture, float lowest) {
    constexpr float kRoom = 150.0f; // for messages above it, too
    const std::string held = held_text(model);
    if (held.empty() || picture.high.y - lowest < kRoom)
        return;
    const float half = ImGui::CalcTextSize(held.c_str()).x / 2 + 2 * kMargin;
    if (story_card_end(model, picture) > (picture.low.x + picture.high.x) / 2 - half)
        return;
    ImGui::SetNextWindowPos({(picture.low.x + picture.high.x) / 2, picture.high.y - kMargin},
                            ImGuiCond_Always, {0.5f, 1.0f});
    ImGui::Begin("###gap", nullptr, kFixed | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoNav);
    text(held);
    ImGui::End();
}

/// What can be done with the file or folder that a message names. @return whether it names one
bool path_buttons(const std::string& message, DesktopWish& wish) {
    const auto path = path_in(message);
    if (!path)
        return false;
    if (can_open_folders()) {
        if (ImGui::SmallButton("open folder"))
            wish.folder = path->parent_path();
        ImGui::SameLine();
    }
    if (ImGui::SmallButton("copy path"))
        wish.text = path->string();
    return true;
}

bool messages_page(const PanelModel& model, DesktopWish& wish) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize(
        {std::min(std::floor(0.96f * screen.x), 620.0f), 2 * std::floor(0.3f * screen.y)});
    bool open = true;
    ImGui::Begin("Messages###messages", &open,
                 ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                     ImGuiWindowFlags_NoSavedSettings);
    if (model.notes.past.empty())
        note("Nothing was said so far.", color_of(Ink::dim));
    for (std::size_t i = model.notes.past.size(); i-- > 0;) { // the newest first
        const PastMessage& each = model.notes.past[i];
        ImGui::PushID(static_cast<int>(i));
        ImGui::TextColored(color_of(Ink::dim), "%s", each.time.c_str());
        ImGui::SameLine();
        ImGui::BeginGroup();
        note(each.words, color_of(Ink::text));
        path_buttons(each.words, wish);
        ImGui::EndGroup();
        ImGui::PopID();
    }
    ImGui::End();
    return open;
}

bool message_window(const Said& said, const PanelBox& free, DesktopWish& wish) {
    if (said.failure.empty() && said.standing.empty() && said.message.empty())
        return false;
    ImGui::SetNextWindowPos({(free.low.x + free.high.x) / 2, free.low.y}, ImGuiCond_Always,
                            {0.5f, 0.0f});
    const ImGuiWindowFlags quiet = said.failure.empty() && !path_in(said.message)
                                       ? ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoNav
                                       : 0;
    ImGui::Begin("###message", nullptr, kFixed | quiet);
    constexpr float kButton = 22.0f;
    const float widest = std::max(60.0f, free.size().x - 6 * kMargin - kButton);
    bool closed = false;
    if (!said.failure.empty()) {
        closed = icon_button("close", Icon::close, "close this message", false, kButton);
        ImGui::SameLine();
    }
    ImGui::BeginGroup();
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + widest);
    for (const auto& [line, ink] :
         {std::pair(&said.failure, Ink::error), std::pair(&said.standing, Ink::warning),
          std::pair(&said.message, Ink::text)})
        if (!line->empty()) {
            ImGui::PushStyleColor(ImGuiCol_Text, color_of(ink));
            ImGui::TextUnformatted(line->c_str());
            ImGui::PopStyleColor();
        }
    ImGui::PopTextWrapPos();
    path_buttons(said.message, wish);
    ImGui::EndGroup();
    ImGui::End();
    return closed;
}

namespace {

bool way_out_button(const EmptyPicture& empty, const char* key) {
    return !empty.way.empty() && ImGui::Button((empty.way + key + "###way out").c_str());
}

} // namespace

bool empty_card(const PanelModel& model, const PanelBox& picture) {
    constexpr float kWidest = 420.0f, kHeight = 0.36f; // share, above the hint for newcomers
    if (!model.notes.empty)
        return false;
    const EmptyPicture& empty = *model.notes.empty;
    const float widest = std::min(kWidest, 0.9f * picture.size().x - 2 * kMargin);
    ImGui::SetNextWindowPos(
        {(picture.low.x + picture.high.x) / 2, picture.low.y + kHeight * picture.size().y},
        ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::Begin("###empty", nullptr, kFixed | ImGuiWindowFlags_NoNav);
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + widest);
    ImGui::TextUnformatted(empty.sentence.c_str());
    ImGui::PopTextWrapPos();
    const bool chosen = way_out_button(empty, " (Enter)");
    ImGui::End();
    return chosen;
}

bool empty_rows(const PanelModel& model) {
    if (!model.notes.empty)
        return false;
    note(model.notes.empty->sentence, color_of(Ink::warning));
    return way_out_button(*model.notes.empty, "");
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
    note("Escape cancels", color_of(Ink::dim));
    ImGui::End();
}

void bring_forward() {
    if (!ImGui::IsWindowAppearing())
        return;
    ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
    ImGui::SetWindowFocus();
}

void dim_rest() {
    constexpr float kDarkness = 0.5f;
    ImGui::SetNextWindowPos({0.0f, 0.0f});
    ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, {0.0f, 0.0f, 0.0f, kDarkness});
    ImGui::Begin("###dim", nullptr,
                 (kFixed | ImGuiWindowFlags_NoBringToFrontOnFocus) &
                     ~ImGuiWindowFlags_AlwaysAutoResize);
    bring_forward();
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
}

void leaving_window(const PanelModel& model, Commands& commands) {
    if (!model.asked.leaving)
        return;
    dim_rest();
    const ImVec2 picture = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({picture.x / 2, picture.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::Begin("Quit Isochron?###leaving", nullptr,
                 ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings);
    bring_forward();
    if (model.recording)
        ImGui::TextUnformatted("The recording will end and be saved.");
    if (model.movies.progress)
        ImGui::TextUnformatted("The movie being made will be discarded.");
    if (ImGui::Button("Quit (Enter)"))
        commands.quit = true;
    ImGui::SameLine();
    if (ImGui::Button("Stay (Escape)"))
        commands.leaving = false;
    ImGui::End();
}

} // namespace isochron::app
