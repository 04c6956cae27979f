// The lane of a film's key frames.
#include "app/panel/parts/film_lane.h"

#include "app/config/first_placement.h"
#include "app/panel/imgui/number_entry.h"
#include "app/panel/panel_words.h"
#include "app/panel/parts/icons.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/theme.h"
#include "app/panel/parts/time_track.h"
#include "interaction/command_fields.h"
#include "interaction/navigation/key_frames.h"
#include "interaction/navigation/story.h"
#include "interaction/recording/key_film.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace isochron::app {

/// The film's frames, and the settings of the one that is shown.
struct FilmPreview {
    std::vector<interaction::RecordedFrame> frames;
    std::vector<interaction::KeyFrame> keys; ///< whose film it is
    interaction::Settings shown;
    std::size_t next = 0; ///< number of the frame that comes next
    double rate = 0, began = 0;
    double seconds() const { return static_cast<double>(next) / rate; }
};

namespace {

using interaction::Commands;
using interaction::KeyFrame;

constexpr float kFilmMark = 6.0f, kFilmHand = 8.0f; ///< panel pixels
constexpr float kKeyList = 430.0f;                  ///< width of the list

std::shared_ptr<FilmPreview> begun_preview(const PanelModel& model) {
    constexpr double kUsualRate = 30, kMostFrames = 20'000;
    auto preview = std::make_shared<FilmPreview>();
    const auto& keys = model.asked.keys;
    preview->keys = keys;
    preview->shown = model.asked;
    preview->rate = std::min(kUsualRate, kMostFrames / interaction::seconds_of(keys));
    preview->began = ImGui::GetTime();
    const auto steps = static_cast<std::size_t>(last_step(model)) + 1;
    interaction::StepTimes times{
        {model.info.times.begin(), model.info.times.begin() + static_cast<std::ptrdiff_t>(steps)}};
    preview->frames = interaction::frames_of(
        keys, {.start = model.asked,
               .seen = {},
               .times = std::move(times),
               .pivot = physical_center(model.info.grid),
               .rate = preview->rate,
               .logarithmic = interaction::is_wide_range(model.stats.low, model.stats.high)});
    return preview;
}

/// Shows the frames up to now. @return whether the film goes on
bool play(const PanelModel& model, FilmPreview& preview, Commands& commands) {
    const double passed = ImGui::GetTime() - preview.began;
    const auto until = std::min(preview.frames.size(),
                                static_cast<std::size_t>(std::max(0.0, passed * preview.rate)) + 1);
    std::optional<interaction::Pose> head;
    for (; preview.next < until; ++preview.next) {
        const interaction::RecordedFrame& frame = preview.frames[preview.next];
        interaction::each_setting([](const interaction::Field&, const auto& change,
                                     auto& setting) { setting = change.value_or(setting); },
                                  frame.commands, preview.shown);
        if (const auto* const device = frame.input.find("head"))
            head = device->pose;
    }
    const KeyFrame now = interaction::key_of(preview.shown, head.value_or(model.head));
    interaction::merge(commands, interaction::way_to_key(now, model.asked, model.head));
    return preview.next < preview.frames.size();
}

/// Where the film's time lies on the screen.
struct LaneTrack {
    float low, high, middle;
    double seconds; ///< at its right end
    float at(double time) const { return low + (high - low) * static_cast<float>(time / seconds); }
    double time_at(float x) const {
        return seconds * static_cast<double>(std::clamp((x - low) / (high - low), 0.0f, 1.0f));
    }
};

void draw_key(const LaneTrack& track, const KeyFrame& key, double time, bool chosen) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float x = track.at(time), end = track.at(time + key.hold);
    const ImU32 color = packed(chosen ? Ink::accent : Ink::text);
    if (key.hold > 0)
        list.AddRectFilled({x, track.middle - 2}, {end, track.middle + 2}, color);
    list.AddQuadFilled({x, track.middle - kFilmMark}, {x + kFilmMark, track.middle},
                       {x, track.middle + kFilmMark}, {x - kFilmMark, track.middle}, color);
}

std::string words_of_mark(const std::vector<KeyFrame>& keys, std::size_t number) {
    return fmt::format(
        "{}, {} of {}, at {:.4g} s{}\na click shows it, drag it to another time of "
        "the film, Delete removes it",
        interaction::name_of_key(keys, number), number + 1, keys.size(), keys[number].time,
        keys[number].hold > 0 ? fmt::format(", held for {:.4g} s", keys[number].hold) : "");
}

/// The marks, and what the hand does with them.
void marks_on(const LaneTrack& track, const PanelModel& model, FilmLane& lane, Commands& commands) {
    const auto& keys = model.asked.keys;
    const float hand = ImGui::GetIO().MousePos.x;
    std::optional<std::size_t> under;
    if (ImGui::IsItemHovered())
        for (std::size_t i = 0; i < keys.size(); ++i)
            if (std::abs(track.at(keys[i].time) - hand) <= kFilmHand &&
                (!under || std::abs(track.at(keys[i].time) - hand) <
                               std::abs(track.at(keys[*under].time) - hand)))
                under = i;
    if (ImGui::IsItemActivated() && under) {
        lane.chosen = lane.dragged = under;
        lane.preview.reset();
    }
    if (lane.dragged && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 3.0f))
        lane.moves = true;
    const bool moves = lane.dragged && lane.moves;
    std::vector<KeyFrame> moved = keys;
    if (moves)
        moved = interaction::with_moved_key(keys, *lane.dragged, track.time_at(hand));
    for (std::size_t i = 0; i < keys.size(); ++i)
        draw_key(track, keys[i], moved[i].time, lane.chosen == i);
    if (moves)
        ImGui::SetTooltip("%s at %.4g s", interaction::name_of_key(keys, *lane.dragged).c_str(),
                          moved[*lane.dragged].time);
    else if (under)
        ImGui::SetTooltip("%s", words_of_mark(keys, *under).c_str());
    if (lane.dragged && ImGui::IsItemDeactivated()) {
        if (moves)
            commands.keys = interaction::with_moved_key(keys, *lane.dragged, track.time_at(hand));
        else
            interaction::merge(
                commands, interaction::way_to_key(keys[*lane.dragged], model.asked, model.head));
        lane.dragged.reset();
        lane.moves = false;
    }
    if (std::exchange(lane.removes, false) && lane.chosen) {
        commands.keys = interaction::without_key(keys, *lane.chosen);
        lane.chosen.reset();
    }
}

/// A text that has been written becomes its key's.
void take_draft(const PanelModel& model, FilmLane& lane, Commands& commands) {
    const auto draft = std::exchange(lane.draft, std::nullopt);
    std::vector<KeyFrame> keys = model.asked.keys;
    if (!draft || draft->first >= keys.size() || keys[draft->first].text == draft->second)
        return;
    keys[draft->first].text = draft->second;
    commands.keys = std::move(keys);
}

/// What the story says at the chosen key, or the first one, and where.
void text_of_key(const PanelModel& model, FilmLane& lane, Commands& commands) {
    const std::size_t number = lane.chosen.value_or(0);
    std::vector<KeyFrame> keys = model.asked.keys;
    ImGui::TextColored(
        color_of(Ink::dim), "%s",
        fmt::format("What the story says at {}", interaction::name_of_key(keys, number)).c_str());
    std::string words =
        lane.draft && lane.draft->first == number ? lane.draft->second : keys[number].text;
    if (text_area(fmt::format("##text{}", number).c_str(), words, kKeyList, 84.0f,
                  interaction::kLongestStoryText))
        lane.draft = {number, words};
    if (ImGui::IsItemDeactivated())
        take_draft(model, lane, commands);
    const auto& mark = model.asked.mark.point;
    const bool placed = keys[number].place.has_value();
    ImGui::BeginDisabled(!mark);
    if (ImGui::Button(placed ? "about the mark instead" : "about the mark")) {
        keys[number].place = mark->position;
        commands.keys = keys;
    }
    ImGui::EndDisabled();
    tip(mark ? "a line leads from the text to the place of the mark"
             : "pick a place: a line leads from the text to it");
    ImGui::SameLine();
    ImGui::BeginDisabled(!placed);
    if (ImGui::Button("about no place")) {
        keys[number].place.reset();
        commands.keys = keys;
    }
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::BeginDisabled(keys[number].text.empty());
    if (ImGui::Button("tell it"))
        commands.story = static_cast<std::uint32_t>(number) + 1;
    ImGui::EndDisabled();
    tip("tell the story from this step (Ctrl + Page Down goes on)");
}

/// The keys as rows of names and numbers.
void list_of_keys(const PanelModel& model, FilmLane& lane, Commands& commands) {
    if (!ImGui::BeginPopup("keys"))
        return take_draft(model, lane, commands);
    constexpr float kMostRows = 8.0f;
    popup_title("Key frames");
    std::vector<KeyFrame> keys = model.asked.keys;
    const float line = kIconButton + ImGui::GetStyle().ItemSpacing.y;
    ImGui::BeginChild("rows",
                      {kKeyList, line * std::min(kMostRows, static_cast<float>(keys.size()))});
    for (std::size_t i = 0; i < keys.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::Selectable(fmt::format("{}", i + 1).c_str(), lane.chosen == i,
                              ImGuiSelectableFlags_DontClosePopups, {24.0f, 0.0f})) {
            lane.chosen = i;
            interaction::merge(commands, interaction::way_to_key(keys[i], model.asked, model.head));
        }
        tip("show this key, and what the story says there");
        ImGui::SameLine();
        ImGui::SetNextItemWidth(150.0f);
        if (std::string name = keys[i].name;
            finished_text("##name", "name", name) && name.size() <= interaction::kLongestText) {
            commands.keys = keys;
            (*commands.keys)[i].name = name;
        }
        const auto field = [&](const char* id, double value, const char* format,
                               const char* words) {
            ImGui::SameLine();
            ImGui::SetNextItemWidth(86.0f);
            double changed = value;
            ImGui::InputDouble(id, &changed, 0, 0, format);
            tip(words);
            return ImGui::IsItemDeactivatedAfterEdit() && std::isfinite(changed)
                       ? std::optional(changed)
                       : std::nullopt;
        };
        if (const auto time = field("##time", keys[i].time, "%.4g s", "when the film is there"))
            commands.keys = interaction::with_moved_key(keys, i, *time);
        if (const auto hold = field("##hold", keys[i].hold, "%.4g s held", "how long it rests"))
            commands.keys = interaction::with_held_key(keys, i, *hold);
        ImGui::SameLine();
        if (icon_button("remove", Icon::remove, "remove this key"))
            commands.keys = interaction::without_key(keys, i);
        ImGui::PopID();
    }
    ImGui::EndChild();
    text_of_key(model, lane, commands);
    ImGui::EndPopup();
}

} // namespace

void film_lane(const PanelModel& model, const PanelLayout& layout, FilmLane& lane,
               Commands& commands) {
    const auto& keys = model.asked.keys;
    if (keys.empty()) {
        lane = {};
        return;
    }
    if (lane.chosen && *lane.chosen >= keys.size())
        lane.chosen.reset();
    if (lane.dragged && *lane.dragged >= keys.size())
        lane.dragged.reset();
    const double seconds = interaction::seconds_of(keys);
    const PanelBox& row = layout.film;
    ImGui::SetNextWindowPos({row.low.x, row.low.y});
    ImGui::SetNextWindowSize({row.size().x, row.size().y});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {14.0f, 2.0f});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, color_of(Ink::bar));
    ImGui::Begin("###film", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
    lane.under_hand = ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
    ImGui::BeginDisabled(keys.size() < 2);
    if (icon_button("play film", lane.preview ? Icon::pause : Icon::play,
                    lane.preview ? "end the preview" : "play the film of these keys")) {
        if (lane.preview)
            lane.preview.reset();
        else
            lane.preview = begun_preview(model);
    }
    ImGui::EndDisabled();
    ImGui::SameLine();
    const std::string length = fmt::format("film {:.4g} s", seconds);
    const float after = ImGui::CalcTextSize(length.c_str()).x + 2 * kIconButton;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = std::max(40.0f, ImGui::GetContentRegionAvail().x - after);
    constexpr double kRoomBehind = 1.15; // so that the last key can be dragged to a later time
    const LaneTrack track{corner.x + kFilmHand, corner.x + width - kFilmHand,
                          corner.y + kIconButton / 2, kRoomBehind * std::max(seconds, 1.0)};
    ImGui::InvisibleButton("##track", {width, kIconButton});
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({track.at(0), track.middle - 1}, {track.at(seconds), track.middle + 1},
                       packed(Ink::line));
    marks_on(track, model, lane, commands);
    if (lane.preview && lane.preview->keys != keys)
        lane.preview.reset();
    if (lane.preview) {
        const float x = track.at(lane.preview->seconds());
        list.AddLine({x, corner.y}, {x, corner.y + kIconButton}, packed(Ink::accent), 2.0f);
        if (!play(model, *lane.preview, commands))
            lane.preview.reset();
    }
    ImGui::SameLine();
    const ImVec2 words = ImGui::GetCursorScreenPos();
    list.AddText({words.x, words.y + (kIconButton - ImGui::GetFontSize()) / 2}, packed(Ink::text),
                 length.c_str());
    ImGui::Dummy({ImGui::CalcTextSize(length.c_str()).x, kIconButton});
    ImGui::SameLine();
    if (icon_button("list of keys", Icon::menu, "the keys with their times"))
        ImGui::OpenPopup("keys");
    list_of_keys(model, lane, commands);
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
}

} // namespace isochron::app
