// The bar of the time: buttons that play, and the track of all steps.
#include "app/panel/parts/time_bar.h"

#include "app/panel/panel_words.h"
#include "app/panel/parts/icons.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/theme.h"
#include "index/volume/time_unit.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace isochron::app {
namespace {

using interaction::Commands;

constexpr float kSpeedField = 46.0f, kStepField = 104.0f;
constexpr float kTrack = 16.0f; ///< its height

std::uint32_t last_step(const PanelModel& model) {
    return static_cast<std::uint32_t>(model.asked.known_steps(model.info.steps()) - 1);
}

std::string time_of(const PanelModel& model, std::uint32_t step) {
    return index::time_text(model.info.times, step, model.info.time_unit);
}

void play_buttons(const PanelModel& model, interaction::PlaybackState& playback,
                  Commands& commands) {
    const std::uint32_t last = last_step(model), step = model.asked.step;
    const auto go_to = [&](std::uint32_t to) {
        commands.step = to;
        playback.playing = false;
    };
    if (icon_button("first", Icon::first, "first step"))
        go_to(0);
    ImGui::SameLine(0.0f, 2.0f);
    if (icon_button("back", Icon::back, "one step back (Left)"))
        go_to(step == 0 ? (playback.loop ? last : 0) : step - 1);
    ImGui::SameLine(0.0f, 2.0f);
    if (icon_button("play", playback.playing ? Icon::pause : Icon::play, "play or pause (Space)",
                    playback.playing))
        playback.playing = !playback.playing;
    ImGui::SameLine(0.0f, 2.0f);
    if (icon_button("forward", Icon::forward, "one step forward (Right)"))
        go_to(step == last ? (playback.loop ? 0 : last) : step + 1);
    ImGui::SameLine(0.0f, 2.0f);
    if (icon_button("last", Icon::last, "last step"))
        go_to(last);
}

/// What is chosen less often than the step.
void menu_of_time(const PanelModel& model, interaction::PlaybackState& playback,
                  Commands& commands) {
    if (icon_button("more", Icon::menu, "more about playing"))
        ImGui::OpenPopup("time");
    if (!ImGui::BeginPopup("time"))
        return;
    ImGui::MenuItem("play backwards", "R", &playback.reverse);
    bool follow = model.asked.follow;
    if (ImGui::MenuItem("always show the newest step", "End", &follow)) {
        commands.follow = follow;
        if (follow)
            commands.step = last_step(model);
    }
    ImGui::EndPopup();
}

void way_of_playing(const PanelModel& model, interaction::PlaybackState& playback,
                    Commands& commands) {
    ImGui::SameLine(0.0f, 8.0f);
    if (icon_button("loop", Icon::loop, "start again after the last step (L)", playback.loop))
        playback.loop = !playback.loop;
    ImGui::SameLine(0.0f, 2.0f);
    menu_of_time(model, playback, commands);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(kSpeedField);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + (kIconButton - ImGui::GetFrameHeight()) / 2);
    number_field("##speed", playback.speed,
                 {.low = interaction::kSlowest, .high = interaction::kFastest, .logarithmic = true},
                 "x %.3g");
    tip("how fast time plays: the whole series takes 10 s at x 1 (+, -)");
}

/// The number of the step, and its time below.
void step_field(const PanelModel& model, Commands& commands) {
    const auto last = static_cast<int>(last_step(model));
    int number = static_cast<int>(model.asked.step) + 1; // people count from 1
    ImGui::SetNextItemWidth(kStepField);
    const std::string format = fmt::format("step %d of {}", last + 1);
    if (whole_number_field("##step", &number, 1, std::max(1, last + 1), format.c_str()))
        commands.step = static_cast<std::uint32_t>(number - 1);
    tip("step: drag, or click and type (Left, Right)");
}

/// The steps on the track. A step has its width; its middle stands for its time.
struct Track {
    ImVec2 low, high;
    std::uint32_t steps;

    float width() const { return (high.x - low.x) / static_cast<float>(steps); }
    float left_of(std::uint32_t step) const { return low.x + width() * static_cast<float>(step); }
    float middle_of(std::uint32_t step) const { return left_of(step) + width() / 2; }
    std::uint32_t step_at(float x) const {
        const float at = std::floor((x - low.x) / width());
        return static_cast<std::uint32_t>(std::clamp(at, 0.0f, static_cast<float>(steps - 1)));
    }
};

/// Texts of some steps below the track, as many as fit.
void times_below(const Track& track, const PanelModel& model) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto width_of = [&](std::uint32_t step) {
        return ImGui::CalcTextSize(time_of(model, step).c_str()).x;
    };
    constexpr float kGap = 18.0f;
    const float widest = std::max(width_of(0), width_of(track.steps - 1));
    const auto most =
        static_cast<std::uint32_t>(std::max(1.0f, (track.high.x - track.low.x) / (widest + kGap)));
    std::uint32_t every = 1;
    for (const std::uint32_t factor : {2u, 5u, 10u})
        while ((track.steps - 1) / every + 1 > most && every < factor)
            every = factor;
    while ((track.steps - 1) / every + 1 > most)
        every *= 2;
    float taken = track.low.x - 1.0f;
    for (std::uint32_t step = 0; step < track.steps; step += every) {
        const std::string text = time_of(model, step);
        const float width = ImGui::CalcTextSize(text.c_str()).x, middle = track.middle_of(step);
        list.AddLine({middle, track.high.y}, {middle, track.high.y + 3.0f}, packed(Ink::dim));
        const float left = std::clamp(middle - width / 2, track.low.x,
                                      std::max(track.low.x, track.high.x - width));
        if (left < taken || left + width > track.high.x + 1.0f)
            continue;
        list.AddText({left, track.high.y + 4.0f}, packed(Ink::dim), text.c_str());
        taken = left + width + kGap / 2;
    }
}

/// Runs of steps that can be shown without a search, shaded. The marks may differ from wall to
/// wall, and a single step needs none.
void steps_at_hand(const Track& track, const PanelModel& model) {
    if (model.place == PanelPlace::in_room || model.work.at_hand_steps.size() < 2)
        return;
    for (const std::uint32_t step : model.work.at_hand_steps)
        if (step < track.steps)
            ImGui::GetWindowDrawList()->AddRectFilled({track.left_of(step), track.low.y},
                                                      {track.left_of(step + 1), track.high.y},
                                                      packed(Ink::columns));
}

void track_of_steps(const PanelModel& model, Commands& commands) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const Track track{corner, {corner.x + width, corner.y + kTrack}, last_step(model) + 1};
    ImGui::InvisibleButton("track", {width, kTrack});
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(track.low, track.high, packed(Ink::control), 3.0f);
    steps_at_hand(track, model);
    const auto handle = [&](std::uint32_t step, Ink ink, float thick) {
        const float x = track.middle_of(std::min(step, track.steps - 1));
        list.AddRectFilled({x - thick - 1, track.low.y - 2}, {x + thick + 1, track.high.y + 2},
                           packed(Ink::bar), 2.0f);
        list.AddRectFilled({x - thick, track.low.y - 1}, {x + thick, track.high.y + 1}, packed(ink),
                           2.0f);
    };
    const auto& shown = model.frame.shown;
    if (shown && shown->step != model.asked.step)
        handle(shown->step, Ink::dim, 1.0f);
    handle(model.asked.step, Ink::accent, 2.5f);
    const std::uint32_t pointed = track.step_at(ImGui::GetIO().MousePos.x);
    if (ImGui::IsItemActive() && pointed != model.asked.step)
        commands.step = pointed;
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("step %u: %s", pointed + 1, time_of(model, pointed).c_str());
    times_below(track, model);
}

} // namespace

void time_bar(const PanelModel& model, bool two_rows, Commands& commands) {
    interaction::PlaybackState playback = model.asked.playback;
    ImGui::BeginDisabled(last_step(model) == 0);
    const ImVec2 start = ImGui::GetCursorPos();
    const float row_height = two_rows ? 36.0f : ImGui::GetWindowHeight();
    ImGui::SetCursorPos({start.x, (row_height - kIconButton) / 2});
    play_buttons(model, playback, commands);
    way_of_playing(model, playback, commands);
    ImGui::SameLine();
    ImGui::SetCursorPosY((row_height - ImGui::GetFrameHeight()) / 2);
    step_field(model, commands);
    if (two_rows) {
        ImGui::SetCursorPos({start.x, row_height + 4.0f});
    } else {
        ImGui::SameLine(0.0f, 14.0f);
        ImGui::SetCursorPosY((row_height - kTrack - ImGui::GetFontSize() - 4.0f) / 2);
    }
    track_of_steps(model, commands);
    ImGui::EndDisabled();
    if (playback != model.asked.playback)
        commands.playback = playback;
}

} // namespace isochron::app
