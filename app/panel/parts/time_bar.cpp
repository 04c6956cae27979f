// The bar of the time: buttons that play, and the track of all steps.
#include "app/panel/parts/time_bar.h"

#include "app/panel/panel_words.h"
#include "app/panel/parts/icons.h"
#include "app/panel/parts/named_list.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/time_track.h"
#include "interaction/step_track.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {
namespace {

using interaction::Commands;

constexpr float kSpeedField = 46.0f, kRateField = 92.0f, kStepField = 104.0f;
constexpr float kWideTime = 900.0f;   ///< has room for all buttons
constexpr float kNarrowTime = 460.0f; ///< below, what has a line in the menu is left out

void play_buttons(const PanelModel& model, interaction::PlaybackState& playback,
                  Commands& commands) {
    const std::uint32_t last = last_step(model);
    const index::Instant now = model.asked.shown_instant();
    interaction::PlaybackState by = playback;
    by.every = 1;
    const interaction::StepRange& range = model.asked.play_range;
    const auto go_to = [&](std::uint32_t to) {
        commands.instant.emplace(to);
        playback.playing = false;
    };
    if (icon_button("first", Icon::first, "first step (Ctrl + Left)"))
        go_to(first_of(range, last + 1));
    ImGui::SameLine(0.0f, 2.0f);
    if (icon_button("back", Icon::back, "one step back (Left)"))
        go_to(previous_step(now, by, last + 1));
    ImGui::SameLine(0.0f, 2.0f);
    if (icon_button("play", playback.playing ? Icon::pause : Icon::play, "play or pause (Space)",
                    playback.playing))
        playback.playing = !playback.playing;
    ImGui::SameLine(0.0f, 2.0f);
    if (icon_button("forward", Icon::forward, "one step forward (Right)"))
        go_to(next_step(now.step, by, last + 1));
    ImGui::SameLine(0.0f, 2.0f);
    if (icon_button("last", Icon::last, "last step (Ctrl + Right)"))
        go_to(last_of(range, last + 1));
}

/// What is chosen less often than the step.
void menu_of_time(const PanelModel& model, interaction::PlaybackState& playback,
                  Commands& commands) {
    if (icon_button("more", Icon::menu, "more about playing"))
        ImGui::OpenPopup("time");
    if (!ImGui::BeginPopup("time"))
        return;
    popup_title("How time plays");
    ImGui::MenuItem("start again after the last step", "L", &playback.loop);
    ImGui::MenuItem("play back and forth", "Ctrl + L", &playback.ping_pong);
    ImGui::MenuItem("play backwards", "R", &playback.reverse);
    bool blends = model.asked.between == interaction::BetweenSteps::blend;
    if (ImGui::MenuItem("blend between steps", "Ctrl + T", &blends))
        commands.between =
            blends ? interaction::BetweenSteps::blend : interaction::BetweenSteps::hold;
    bool follow = model.asked.follow;
    if (ImGui::MenuItem("always show the newest step", "End", &follow)) {
        commands.follow = follow;
        if (follow)
            commands.instant.emplace(last_step(model));
    }
    const interaction::StepRange range = model.asked.play_range;
    if (ImGui::MenuItem("begin playing at this step", "Ctrl + ,"))
        commands.play_range = interaction::begun_at(model.asked.instant.step, range);
    if (ImGui::MenuItem("end playing at this step", "Ctrl + ."))
        commands.play_range = interaction::ended_at(model.asked.instant.step, range);
    if (ImGui::MenuItem("play all steps", "Ctrl + Shift + .", false,
                        range != interaction::StepRange{}))
        commands.play_range = interaction::StepRange{};
    ImGui::Separator();
    row("play");
    ImGui::SetNextItemWidth(150.0f);
    auto every = static_cast<int>(playback.every);
    const int most = std::clamp(static_cast<int>(last_step(model)), 2,
                                static_cast<int>(interaction::kMostSkipped));
    if (whole_number_field("##every", &every, 1, most, every == 1 ? "every step" : "1 step in %d"))
        playback.every = static_cast<std::uint32_t>(every);
    tip("skips steps while time plays (Ctrl + +, Ctrl + -)");
    row("speed in");
    ImGui::SetNextItemWidth(150.0f);
    const std::vector<std::string> units{"series in 10 s", "steps a second", "the data's time"};
    if (const auto unit = choice_field("##unit", units[static_cast<std::size_t>(playback.unit)],
                                       units, "what the speed counts (Ctrl + R)"))
        playback =
            counted_in(static_cast<interaction::SpeedUnit>(*unit), playback, model.info.times);
    ImGui::EndPopup();
}

/// The speed, in the unit in which it counts.
void speed_field(const PanelModel& model, interaction::PlaybackState& playback) {
    using interaction::SpeedUnit;
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + (kIconButton - ImGui::GetFrameHeight()) / 2);
    if (playback.unit == SpeedUnit::series) {
        ImGui::SetNextItemWidth(kSpeedField);
        number_field(
            "##speed", playback.speed,
            {.low = interaction::kSlowest, .high = interaction::kFastest, .logarithmic = true},
            "x %.3g");
        tip("how fast time plays: the whole series takes 10 s at x 1 (+, -)");
        return;
    }
    // The data say how fast is usual: from a hundredth of the whole series a second to all of it.
    const bool steps = playback.unit == SpeedUnit::steps;
    const double whole = steps ? 240.0 : interaction::period(model.info.times);
    const std::string& unit = model.info.time_unit;
    const bool named = !steps && !unit.empty() && unit.size() < 6;
    ImGui::SetNextItemWidth(kRateField);
    number_field("##rate", playback.rate,
                 {.low = whole > 0 ? whole / 1000 : interaction::kSlowestRate,
                  .high = whole > 0 ? whole : interaction::kFastestRate,
                  .logarithmic = true,
                  .bounded = false},
                 (steps   ? std::string("%.3g steps/s")
                  : named ? format_with(unit + "/s")
                          : std::string("%.3g a second"))
                     .c_str());
    playback.rate = std::clamp(playback.rate, interaction::kSlowestRate, interaction::kFastestRate);
    tip(steps ? "how many steps are shown in a second (+, -)"
              : "how much of the data's time passes in a second (+, -)");
}

void way_of_playing(const PanelModel& model, float width, interaction::PlaybackState& playback,
                    Commands& commands) {
    ImGui::SameLine(0.0f, width >= kNarrowTime ? 8.0f : 4.0f);
    if (width >= kNarrowTime) {
        if (icon_button("loop", Icon::loop, "start again after the last step (L)", playback.loop))
            playback.loop = !playback.loop;
        ImGui::SameLine(0.0f, 2.0f);
    }
    if (width >= kWideTime) {
        if (icon_button("fro", Icon::to_and_fro, "play back and forth (Ctrl + L)",
                        playback.ping_pong))
            playback.ping_pong = !playback.ping_pong;
        ImGui::SameLine(0.0f, 2.0f);
        const bool blends = model.asked.between == interaction::BetweenSteps::blend;
        if (icon_button("blend", Icon::blend,
                        blends ? "steps blend into each other: a click lets time jump (Ctrl + T)"
                               : "time jumps from step to step: a click blends them (Ctrl + T)",
                        blends))
            commands.between =
                blends ? interaction::BetweenSteps::hold : interaction::BetweenSteps::blend;
        ImGui::SameLine(0.0f, 2.0f);
    }
    menu_of_time(model, playback, commands);
    ImGui::SameLine();
    speed_field(model, playback);
}

/// The bookmarks by name, which the user renames and removes.
void list_of_bookmarks(const PanelModel& model, interaction::PlaybackState& playback,
                       Commands& commands) {
    if (!ImGui::BeginPopup("bookmarks"))
        return;
    popup_title("Bookmarks");
    auto marks = model.asked.bookmarks;
    std::vector<NamedRow> rows;
    for (const interaction::Bookmark& each : marks)
        rows.push_back(
            {each.name,
             each.instant.step < model.info.steps() ? time_of(model, each.instant) : std::string(),
             each.instant == model.asked.shown_instant()});
    const bool marked = std::ranges::any_of(rows, [](const NamedRow& each) { return each.here; });
    if (ImGui::MenuItem(marked ? "remove the bookmark of this time" : "bookmark this time",
                        "Ctrl + B"))
        commands.bookmarks = interaction::toggled_bookmark(marks, model.asked.shown_instant());
    const auto go_to = [&](const std::optional<index::Instant>& at) {
        if (at)
            show(*at, commands);
        playback.playing = false;
    };
    if (ImGui::MenuItem("next bookmark", "Ctrl + N", false, !marks.empty()))
        go_to(next_bookmark(marks, model.asked.shown_instant(), model.asked.blends()));
    if (ImGui::MenuItem("previous bookmark", "Ctrl + Shift + N", false, !marks.empty()))
        go_to(previous_bookmark(marks, model.asked.shown_instant(), model.asked.blends()));
    if (!marks.empty()) {
        ImGui::Separator();
        const NamedChange change = named_list(rows, "show this time");
        if (change.chosen)
            go_to(marks[*change.chosen].instant);
        if (change.renamed)
            marks[change.renamed->first].name = change.renamed->second;
        if (change.removed)
            marks.erase(marks.begin() + static_cast<std::ptrdiff_t>(*change.removed));
        if (change.renamed || change.removed)
            commands.bookmarks = marks;
    }
    ImGui::EndPopup();
}

void bookmark_buttons(const PanelModel& model, bool wide, interaction::PlaybackState& playback,
                      Commands& commands) {
    const auto& marks = model.asked.bookmarks;
    const auto leap = [&](const char* id, Icon icon, const char* words,
                          const std::optional<index::Instant>& at) {
        ImGui::BeginDisabled(!at);
        if (icon_button(id, icon, words) && at) {
            show(*at, commands);
            playback.playing = false;
        }
        ImGui::EndDisabled();
        ImGui::SameLine(0.0f, 2.0f);
    };
    if (wide) {
        leap("bookmark back", Icon::bookmark_back, "previous bookmark (Ctrl + Shift + N)",
             previous_bookmark(marks, model.asked.shown_instant(), model.asked.blends()));
        leap("bookmark forward", Icon::bookmark_forward, "next bookmark (Ctrl + N)",
             next_bookmark(marks, model.asked.shown_instant(), model.asked.blends()));
    }
    if (icon_button("bookmarks", Icon::bookmark, "bookmarks: times to come back to (Ctrl + B)"))
        ImGui::OpenPopup("bookmarks");
    list_of_bookmarks(model, playback, commands);
}

/// The number of the step, and its time below.
void step_field(const PanelModel& model, Commands& commands) {
    const auto last = static_cast<int>(last_step(model));
    int number = static_cast<int>(model.asked.instant.step) + 1; // people count from 1
    ImGui::SetNextItemWidth(kStepField);
    const index::Instant at = model.asked.shown_instant();
    const std::string held = held_text(model);
    const std::string format = at.between()    ? fmt::format("%d to {}", number + 1)
                               : !held.empty() ? fmt::format("gap: %d to {}", number + 1)
                                               : fmt::format("step %d of {}", last + 1);
    if (whole_number_field("##step", &number, 1, std::max(1, last + 1), format.c_str()))
        commands.instant.emplace(static_cast<std::uint32_t>(number - 1));
    tip(((held.empty() ? "" : held + "\n") + "step: drag, or click and type (Left, Right)")
            .c_str());
}

void curves_button(const PanelModel& model, Commands& commands) {
    interaction::CurveDrawer drawer = model.asked.curves;
    if (!icon_button("curves", Icon::curves,
                     "curves over all steps: area, volume, pieces of the surfaces (Ctrl + D)",
                     drawer.shown))
        return;
    drawer.shown = !drawer.shown;
    commands.curves = drawer;
}

} // namespace

void time_bar(const PanelModel& model, bool two_rows, Commands& commands) {
    interaction::PlaybackState playback = model.asked.playback;
    const float width = ImGui::GetWindowWidth();
    ImGui::BeginDisabled(last_step(model) == 0);
    const ImVec2 start = ImGui::GetCursorPos();
    const float row_height = two_rows ? 34.0f : ImGui::GetWindowHeight();
    ImGui::SetCursorPos({start.x, (row_height - kIconButton) / 2});
    play_buttons(model, playback, commands);
    way_of_playing(model, width, playback, commands);
    ImGui::SameLine();
    ImGui::SetCursorPosY((row_height - ImGui::GetFrameHeight()) / 2);
    step_field(model, commands);
    ImGui::SameLine(0.0f, 4.0f);
    ImGui::SetCursorPosY((row_height - kIconButton) / 2);
    bookmark_buttons(model, width >= kWideTime, playback, commands);
    if (width >= kNarrowTime) {
        ImGui::SameLine(0.0f, 2.0f);
        curves_button(model, commands);
    }
    if (two_rows) {
        ImGui::SetCursorPos({start.x, row_height});
    } else {
        ImGui::SameLine(0.0f, 12.0f);
        ImGui::SetCursorPosY(2.0f);
    }
    time_track(model, commands);
    ImGui::EndDisabled();
    if (playback != model.asked.playback)
        commands.playback = playback;
}

} // namespace isochron::app
