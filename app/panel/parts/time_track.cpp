// The track of all steps: the range that plays, bookmarks as flags, and steps at hand.
#include "app/panel/parts/time_track.h"

#include "app/panel/panel_words.h"
#include "app/panel/parts/theme.h"
#include "index/volume/instant_text.h"
#include "interaction/step_track.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace isochron::app {
namespace {

using interaction::Bookmark;
using interaction::Commands;
using interaction::StepRange;

constexpr float kReachOfEnd = 8.0f, kReachOfFlag = 7.0f; ///< for the hand, panel pixels

/// The steps on the track. A step has its width; its middle stands for its time.
struct Track {
    ImVec2 low, high; ///< corners of the track; the lane lies above it
    std::uint32_t steps;

    float width() const { return (high.x - low.x) / static_cast<float>(steps); }
    float left_of(std::uint32_t step) const { return low.x + width() * static_cast<float>(step); }
    float middle_of(std::uint32_t step) const { return left_of(step) + width() / 2; }
    float middle_of(index::Instant at) const {
        return middle_of(at.step) +
               width() * static_cast<float>(at.fraction) / index::Instant::kFractions;
    }
    /// The instant at a place. @param snap within so many pixels of a step it is the step
    index::Instant instant_at(float x, float snap) const {
        const float place = std::clamp((x - middle_of(std::uint32_t{0})) / width(), 0.0f,
                                       static_cast<float>(steps - 1));
        if (std::abs(place - std::round(place)) * width() <= snap)
            return index::Instant(static_cast<std::uint32_t>(std::round(place)));
        const auto step = static_cast<std::uint32_t>(place);
        const auto fraction = static_cast<std::uint32_t>(
            (place - static_cast<float>(step)) * static_cast<float>(index::Instant::kFractions));
        return {step, std::min(fraction, interaction::kMostFraction)};
    }
    std::uint32_t step_at(float x) const {
        const float at = std::floor((x - low.x) / width());
        return static_cast<std::uint32_t>(std::clamp(at, 0.0f, static_cast<float>(steps - 1)));
    }
    /// Where the ends of a range are drawn and taken.
    float begin_of(const StepRange& range) const { return left_of(first_of(range, steps)); }
    float end_of(const StepRange& range) const { return left_of(last_of(range, steps) + 1); }
};

/// Decimals of a number before its unit; empty: the text is no plain number, such as a date.
std::optional<std::size_t> decimals_of(const std::string& text) {
    const std::string number = text.substr(0, text.find(' '));
    if (number.empty() || number.find_first_not_of("-.0123456789") != number.npos ||
        number.find('-', 1) != number.npos)
        return std::nullopt;
    const std::size_t point = number.find('.');
    return point == number.npos ? 0 : number.size() - point - 1;
}

/// The text with as many decimals as those beside it, if it is a plain number.
std::string with_decimals(std::string text, std::size_t decimals) {
    const auto own = decimals_of(text);
    if (own && *own < decimals)
        text.insert(std::min(text.find(' '), text.size()),
                    (*own == 0 ? "." : "") + std::string(decimals - *own, '0'));
    return text;
}

/// Texts of some steps below the track, as many as fit.
void times_below(const Track& track, const PanelModel& model) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    std::size_t decimals = 0;
    const auto text_of = [&](std::uint32_t step) {
        return with_decimals(time_of(model, index::Instant(step)), decimals);
    };
    constexpr std::uint32_t kRead = 16; // as even times have the most decimals early
    for (std::uint32_t step = 0; step < std::min(track.steps, kRead); ++step)
        decimals = std::max(decimals, decimals_of(text_of(step)).value_or(0));
    const auto width_of = [&](std::uint32_t step) {
        return ImGui::CalcTextSize(text_of(step).c_str()).x;
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
        const std::string text = text_of(step);
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

bool is_gap(const PanelModel& model, std::uint32_t step) {
    return model.asked.blends() && std::ranges::binary_search(model.gaps, step);
}

std::string gap_text(std::uint32_t step) {
    return fmt::format("held: a gap between steps {} and {}", step + 1, step + 2);
}

bool names_miss_after(const PanelModel& model, std::uint32_t step) {
    return std::ranges::binary_search(model.info.missing_after, step);
}

/// Where steps are held, the track is open between the two of a gap.
void gaps_on(const Track& track, const PanelModel& model) {
    if (model.asked.blends())
        return;
    const float open = std::min(2.0f, track.width() / 4); // pixels to both sides
    for (const std::uint32_t step : model.gaps)
        if (step + 1 < track.steps) {
            const float x = track.left_of(step + 1);
            ImGui::GetWindowDrawList()->AddRectFilled({x - open, track.low.y},
                                                      {x + open, track.high.y}, packed(Ink::bar));
        }
}

/// Where steps are blended: the track is open at gaps, and has a tick at every step, or at every so
/// many of them if these lie close. Those that the shown moment lies between have long ticks.
void true_steps_on(const Track& track, const PanelModel& model) {
    if (!model.asked.blends() || track.steps < 2)
        return;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    float taken = track.low.x;
    for (const std::uint32_t step : model.gaps) {
        constexpr float kSeen = 1.0f; // pixels
        const float end = step + 1 < track.steps ? track.middle_of(step + 1) : track.low.x;
        if (end < taken + kSeen)
            continue;
        list.AddRectFilled({std::max(taken, track.middle_of(step)), track.low.y},
                           {end, track.high.y}, packed(Ink::bar));
        taken = end;
    }
    const auto tick = [&](std::uint32_t step, float top, Ink ink) {
        const float x = std::floor(track.middle_of(step));
        list.AddRectFilled({x, top}, {x + 1, track.high.y}, packed(ink));
    };
    constexpr float kApart = 4.0f, kTick = 5.0f; // pixels
    const float apart = kApart / track.width();
    std::uint32_t every = 1;
    for (std::uint32_t factor : {2u, 5u, 10u})
        if (static_cast<float>(every) < apart)
            every = factor;
    while (static_cast<float>(every) < apart)
        every *= 2;
    for (std::uint32_t step = 0; step < track.steps; step += every)
        tick(step, track.high.y - kTick, Ink::dim);
    const index::Instant now = model.asked.shown_instant();
    for (std::uint32_t step = now.step; now.between() && step < now.step + 2; ++step)
        tick(step, track.low.y, Ink::text);
}

/// The ends of the range as tabs in the lane, joined by a bar; the steps outside are dimmed.
void range_on(const Track& track, const StepRange& range) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float begin = track.begin_of(range), end = track.end_of(range);
    ImVec4 veil = color_of(Ink::bar);
    veil.w = 0.65f;
    const ImU32 dimmed = ImGui::ColorConvertFloat4ToU32(veil);
    if (begin > track.low.x)
        list.AddRectFilled(track.low, {begin, track.high.y}, dimmed, 3.0f);
    if (end < track.high.x)
        list.AddRectFilled({end, track.low.y}, track.high, dimmed, 3.0f);
    const float top = track.low.y - kLaneHeight, bottom = track.low.y - 2.0f;
    const bool set = range != StepRange{};
    const ImU32 ink = packed(set ? Ink::accent : Ink::columns);
    list.AddRectFilled({begin, bottom - 1.5f}, {end, bottom}, ink);
    list.AddTriangleFilled({begin, top + 3}, {begin + 7, top + 3}, {begin, bottom}, ink);
    list.AddTriangleFilled({end, top + 3}, {end - 7, top + 3}, {end, bottom}, ink);
    if (!set)
        return;
    list.AddLine({begin, bottom}, {begin, track.high.y}, ink);
    list.AddLine({end, bottom}, {end, track.high.y}, ink);
}

void flags_on(const Track& track, const PanelModel& model) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float top = track.low.y - kLaneHeight;
    for (const Bookmark& mark : model.asked.bookmarks) {
        if (mark.instant.step >= track.steps)
            continue;
        const float x = track.middle_of(mark.instant);
        const ImU32 ink =
            packed(mark.instant == model.asked.shown_instant() ? Ink::accent : Ink::warning);
        list.AddLine({x, top}, {x, track.high.y}, ink, 1.5f);
        list.AddTriangleFilled({x, top}, {x + 8, top + 3.5f}, {x, top + 7}, ink);
    }
}

/// What a press in the lane takes.
struct Taken {
    enum Kind : int { nothing, begin, end, flag } kind = nothing;
    std::size_t bookmark = 0;
};
Taken taken_at(const Track& track, const PanelModel& model, float x) {
    Taken taken;
    float nearest = kReachOfFlag;
    for (std::size_t i = 0; i < model.asked.bookmarks.size(); ++i) {
        const index::Instant at = model.asked.bookmarks[i].instant;
        if (at.step >= track.steps)
            continue;
        // The flag hangs to the right of its pole.
        const float away = std::abs(track.middle_of(at) + 3.0f - x);
        if (away < nearest) {
            nearest = away;
            taken = {Taken::flag, i};
        }
    }
    if (taken.kind != Taken::nothing)
        return taken;
    const float begin = std::abs(track.begin_of(model.asked.play_range) - x);
    const float end = std::abs(track.end_of(model.asked.play_range) - x);
    if (std::min(begin, end) < kReachOfEnd)
        taken.kind = begin < end ? Taken::begin : Taken::end;
    return taken;
}

StepRange dragged(Taken::Kind end, std::uint32_t step, const Track& track, StepRange range) {
    if (end == Taken::begin) {
        step = std::min(step, last_of(range, track.steps));
        range.first = step == 0 ? std::nullopt : std::optional(step);
    } else {
        step = std::max(step, first_of(range, track.steps));
        range.last = step + 1 == track.steps ? std::nullopt : std::optional(step);
    }
    return range;
}

void tip_of_lane(const Taken& taken, const Track& track, const PanelModel& model) {
    const StepRange& range = model.asked.play_range;
    if (taken.kind == Taken::flag) {
        const Bookmark& mark = model.asked.bookmarks[taken.bookmark];
        ImGui::SetTooltip("%s: %s", mark.name.c_str(), time_of(model, mark.instant).c_str());
    } else if (taken.kind == Taken::begin) {
        ImGui::SetTooltip("playing begins at step %u: drag (Ctrl + ,)",
                          first_of(range, track.steps) + 1);
    } else if (taken.kind == Taken::end) {
        ImGui::SetTooltip("playing ends at step %u: drag (Ctrl + .)",
                          last_of(range, track.steps) + 1);
    }
}

void go_to(index::Instant at, const PanelModel& model, Commands& commands) {
    show(at, commands);
    if (!model.asked.playback.playing)
        return;
    commands.playback = model.asked.playback;
    commands.playback->playing = false;
}

/// The lane above the track: the ends of the range are dragged, flags are clicked.
void lane(const Track& track, const PanelModel& model, Commands& commands) {
    int* const held = ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("end"), Taken::nothing);
    ImGui::InvisibleButton("lane", {track.high.x - track.low.x, kLaneHeight});
    const float x = ImGui::GetIO().MousePos.x;
    const Taken near = taken_at(track, model, x);
    if (ImGui::IsItemActivated()) {
        *held = near.kind;
        if (near.kind == Taken::flag)
            go_to(model.asked.bookmarks[near.bookmark].instant, model, commands);
    }
    if (ImGui::IsItemActive() && (*held == Taken::begin || *held == Taken::end)) {
        const StepRange range = dragged(static_cast<Taken::Kind>(*held), track.step_at(x), track,
                                        model.asked.play_range);
        if (range != model.asked.play_range)
            commands.play_range = range;
    }
    if (!ImGui::IsItemHovered())
        return;
    tip_of_lane(near, track, model);
}

void tip_of_track(const Track& track, const PanelModel& model, std::uint32_t pointed) {
    std::string words =
        fmt::format("step {}: {}", pointed + 1, time_of(model, index::Instant(pointed)));
    const index::Instant at = track.instant_at(ImGui::GetIO().MousePos.x, 0.0f);
    if (is_gap(model, at.step))
        words += "\n" + gap_text(at.step);
    else if (std::ranges::binary_search(model.gaps, pointed))
        words += fmt::format("\na gap behind it: {}",
                             names_miss_after(model, pointed)
                                 ? "numbers are missing in the names of the files"
                                 : "the next one is more than three times as far away as usual");
    ImGui::SetTooltip("%s", words.c_str());
}

/// What can be done with the step that the right button was pressed on.
void menu_of_step(std::uint32_t step, const PanelModel& model, Commands& commands) {
    if (!ImGui::BeginPopup("step"))
        return;
    popup_title("This step");
    const auto& marks = model.asked.bookmarks;
    const bool marked =
        std::ranges::find(marks, index::Instant(step), &Bookmark::instant) != marks.end();
    ImGui::TextColored(color_of(Ink::dim), "step %u: %s", step + 1,
                       time_of(model, index::Instant(step)).c_str());
    if (ImGui::MenuItem(marked ? "remove the bookmark" : "bookmark this step"))
        commands.bookmarks = interaction::toggled_bookmark(marks, index::Instant(step));
    const StepRange& range = model.asked.play_range;
    if (ImGui::MenuItem("begin playing here"))
        commands.play_range = interaction::begun_at(step, {std::nullopt, range.last});
    if (ImGui::MenuItem("end playing here"))
        commands.play_range = interaction::ended_at(step, {range.first, std::nullopt});
    if (ImGui::MenuItem("play all steps", "Ctrl + Shift + .", false, range != StepRange{}))
        commands.play_range = StepRange{};
    ImGui::EndPopup();
}

void handles_on(const Track& track, const PanelModel& model) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto handle = [&](index::Instant at, Ink ink, float thick) {
        const float x = track.middle_of(at.within(track.steps));
        list.AddRectFilled({x - thick - 1, track.low.y - 2}, {x + thick + 1, track.high.y + 2},
                           packed(Ink::bar), 2.0f);
        list.AddRectFilled({x - thick, track.low.y - 1}, {x + thick, track.high.y + 1}, packed(ink),
                           2.0f);
    };
    const auto& shown = model.frame.shown;
    const index::Instant now = model.asked.shown_instant();
    if (shown && shown->instant != now)
        handle(shown->instant, Ink::dim, 1.0f);
    handle(now, Ink::accent, 2.5f);
}

} // namespace

void show(index::Instant at, Commands& commands) {
    commands.instant = at;
}

std::uint32_t last_step(const PanelModel& model) {
    return static_cast<std::uint32_t>(model.asked.known_steps(model.info.steps()) - 1);
}

std::string time_of(const PanelModel& model, index::Instant at) {
    return index::instant_text(model.info.times, at, model.info.time_unit);
}

std::string gaps_words(const PanelModel& model) {
    constexpr std::size_t kNamed = 3;
    std::vector<std::uint32_t> named;
    for (const std::uint32_t step : model.gaps)
        if (named.size() < kNamed)
            named.push_back(step + 1);
    const std::size_t count = model.gaps.size();
    return count == 0 ? ""
                      : fmt::format("{}: after step{} {}{}", count, count == 1 ? "" : "s",
                                    fmt::join(named, ", "), count > kNamed ? " ..." : "");
}

std::string gaps_in_words(const PanelModel& model) {
    const bool names = std::ranges::any_of(
        model.gaps, [&](std::uint32_t step) { return names_miss_after(model, step); });
    return fmt::format("{}:\nthe step before a gap stays until the next one",
                       names ? "numbers are missing in the names of the files"
                             : "some steps are more than three times as far apart as usual");
}

std::string held_text(const PanelModel& model) {
    const index::Instant now = model.asked.shown_instant();
    if (now.between())
        return fmt::format("between steps {} and {}", now.step + 1, now.step + 2);
    return is_gap(model, now.step) ? gap_text(now.step) : "";
}

void time_track(const PanelModel& model, Commands& commands) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    constexpr float kLeastWidth = 16.0f; // narrow windows have no room left; corners are round
    const float width = std::max(ImGui::GetContentRegionAvail().x, kLeastWidth);
    const float top = corner.y + kLaneHeight;
    const Track track{
        {corner.x, top}, {corner.x + width, top + kTrackHeight}, last_step(model) + 1};
    lane(track, model, commands);
    const bool menu = ImGui::IsItemClicked(ImGuiMouseButton_Right);
    ImGui::SetCursorScreenPos(track.low);
    ImGui::InvisibleButton("track", {width, kTrackHeight});
    const std::uint32_t pointed = track.step_at(ImGui::GetIO().MousePos.x);
    int* const of_menu = ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("of menu"));
    if (menu || ImGui::IsItemClicked(ImGuiMouseButton_Right)) {
        *of_menu = static_cast<int>(pointed);
        ImGui::OpenPopup("step");
    }
    if (ImGui::IsItemActive() && model.asked.blends()) {
        constexpr float kSnap = 2.0f; // pixels
        const index::Instant at = track.instant_at(ImGui::GetIO().MousePos.x, kSnap);
        if (at != model.asked.shown_instant())
            commands.instant = at;
    } else if (ImGui::IsItemActive() && pointed != model.asked.instant.step) {
        commands.instant.emplace(pointed);
    }
    if (ImGui::IsItemHovered())
        tip_of_track(track, model, pointed);
    ImGui::GetWindowDrawList()->AddRectFilled(track.low, track.high, packed(Ink::control), 3.0f);
    steps_at_hand(track, model);
    gaps_on(track, model);
    true_steps_on(track, model);
    range_on(track, model.asked.play_range);
    flags_on(track, model);
    handles_on(track, model);
    times_below(track, model);
    menu_of_step(static_cast<std::uint32_t>(*of_menu), model, commands);
}

} // namespace isochron::app
