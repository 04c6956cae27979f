// What pictures and movies that are written show, and their size.
#include "app/panel/parts/written_pictures.h"

#include "app/panel/imgui/number_entry.h"
#include "app/panel/panel_words.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/theme.h"
#include "interaction/controls/key_frame_controls.h"
#include "interaction/navigation/key_frames.h"
#include "interaction/navigation/story.h"
#include "interaction/step_track.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

using interaction::WrittenPictures;

constexpr float kField = 190.0f;
constexpr std::array<std::pair<std::uint32_t, std::uint32_t>, 5> kSizes{
    {{1280, 720}, {1920, 1080}, {2560, 1440}, {3840, 2160}, {2048, 2048}}};

void size_rows(WrittenPictures& pictures) {
    std::vector<std::string> words{"as in the window"};
    for (const auto& [width, height] : kSizes)
        words.push_back(fmt::format("{} x {}", width, height));
    const bool own = pictures.width > 0 && pictures.height > 0;
    const std::string now =
        own ? fmt::format("{} x {}", pictures.width, pictures.height) : words.front();
    row("size");
    ImGui::SetNextItemWidth(kField);
    if (const auto chosen = choice_field("##size", now, words, "size of pictures and movies")) {
        pictures.width = *chosen == 0 ? 0 : kSizes[*chosen - 1].first;
        pictures.height = *chosen == 0 ? 0 : kSizes[*chosen - 1].second;
    }
    if (!own)
        return;
    constexpr int kLeast = 16, kMost = static_cast<int>(interaction::kLargestPicture);
    auto width = static_cast<int>(pictures.width), height = static_cast<int>(pictures.height);
    row("");
    ImGui::SetNextItemWidth(kField / 2 - 3.0f);
    if (whole_number_field("##width", &width, kLeast, kMost, "%d wide"))
        pictures.width = static_cast<std::uint32_t>(width);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(kField / 2 - 3.0f);
    if (whole_number_field("##height", &height, kLeast, kMost, "%d high"))
        pictures.height = static_cast<std::uint32_t>(height);
}

void background_row(WrittenPictures& pictures) {
    static const std::vector<std::string> kWords{"as set in View", "white", "transparent"};
    row("background");
    ImGui::SetNextItemWidth(kField);
    if (const auto chosen = choice_field(
            "##background", kWords[static_cast<std::size_t>(pictures.background)], kWords,
            "behind the data; words and lines on white are dark. Where the window lifts "
            "a dark background (Ctrl + G), pictures keep the dark one"))
        pictures.background = static_cast<interaction::WrittenBackground>(*chosen);
}

void keep(const PanelModel& model, const WrittenPictures& pictures,
          interaction::Commands& commands) {
    if (pictures != model.asked.pictures)
        commands.pictures = pictures;
}

} // namespace

void folder_row(WrittenPictures& pictures) {
    row("folder");
    ImGui::SetNextItemWidth(kField);
    std::string folder = pictures.folder;
    if (finished_text("##folder", "usual folder", folder))
        pictures.folder = folder;
    tip("where pictures, movies, recordings and surfaces are saved; it is made if it is missing");
}

void picture_rows(const PanelModel& model, interaction::Commands& commands) {
    WrittenPictures pictures = model.asked.pictures;
    const auto part = [](const char* label, const char* id, bool& on, const char* words,
                         const char* effect) {
        row(label);
        tick_field(id, on, words);
        tip(effect);
    };
    part("show", "##legend", pictures.legend, "legend", "which colors stand for which values");
    part("", "##scale", pictures.scale_bar, "scale bar and axes",
         "a length in the data's unit, and how the axes lie");
    part("", "##box", pictures.box, "box with numbers", "where it is shown in the window, too (O)");
    part("", "##marks", pictures.marks, "mark, ruler and clip plane", "with their labels");
    part("", "##caption", pictures.caption, "caption", "array, isovalues and time in a corner");
    background_row(pictures);
    size_rows(pictures);
    row("scale");
    ImGui::SetNextItemWidth(kField);
    number_field("##scale_by", pictures.scale, {.low = 1, .high = interaction::kLargestScale},
                 "%.3g times as large");
    tip("words and lines grow with the picture");
    row("dpi");
    ImGui::SetNextItemWidth(kField);
    number_field("##dpi", pictures.dpi, {.low = 0, .high = interaction::kMostDpi},
                 pictures.dpi > 0 ? "%.4g pixels an inch" : "not said");
    tip("what the file says to programs that lay out pages");
    folder_row(pictures);
    keep(model, pictures, commands);
}

/// The film's key frames. @return what the user wants to be made of them
std::optional<MovieWish> key_row(const PanelModel& model, interaction::Commands& commands) {
    using interaction::Action;
    const auto& keys = model.asked.keys;
    const double seconds = interaction::seconds_of(keys);
    text_row("keys", keys.size() < 2
                         ? fmt::format("{}", keys.size())
                         : fmt::format("{} in {:.4g} s, {:.0f} pictures", keys.size(), seconds,
                                       std::ceil(seconds * model.asked.pictures.rate) + 1));
    tip("views, moments and settings through which a film goes");
    constexpr std::array<std::tuple<const char*, Action, const char*>, 4> kButtons{
        {{"add", Action::add_key, "make what is seen the film's next key (Ctrl + M)"},
         {"remove", Action::remove_key, "remove the key that is seen, or the last one"},
         {"previous", Action::previous_key, "go to the key before (Ctrl + Shift + J)"},
         {"next", Action::next_key, "go to the next key (Ctrl + J)"}}};
    std::vector<std::string> notes;
    for (const auto& [label, action, effect] : kButtons) {
        ImGui::BeginDisabled(action != Action::add_key && keys.empty());
        if (ImGui::Button(fmt::format("{}##key", label).c_str()))
            press_key_frames(action, model.asked, model.head, commands, notes);
        ImGui::EndDisabled();
        tip(effect);
        if (action != Action::next_key)
            ImGui::SameLine();
    }
    std::optional<MovieWish> wish;
    const auto button = [&](const char* label, MovieWish wanted, bool can, const char* effect,
                            const char* why_not) {
        ImGui::BeginDisabled(!can);
        if (ImGui::Button(label))
            wish = wanted;
        ImGui::EndDisabled();
        tip(can ? effect : why_not);
    };
    const bool film = keys.size() > 1;
    button("film of these keys", MovieWish::keys, film, "a movie that goes through all keys",
           "a film needs two keys");
    ImGui::SameLine();
    button("with titles", MovieWish::titled, film && interaction::has_titles(keys),
           "the same, with the names and texts of the keys at the bottom",
           film ? "no key has a name or a text: the list of keys below the picture gives them"
                : "a film needs two keys");
    ImGui::SameLine();
    button("save as story", MovieWish::story, interaction::story_step(keys, 0).of > 0,
           "a file of the keys beside the data: `isochron explore` opens it and tells the story",
           "no key has a text: the list of keys below the picture gives it one");
    return wish;
}

std::optional<MovieWish> movie_rows(const PanelModel& model, interaction::Commands& commands) {
    std::optional<MovieWish> wish;
    if (model.movies.progress) {
        ImGui::ProgressBar(*model.movies.progress, {160.0f, 0.0f});
        ImGui::SameLine();
        if (ImGui::Button("Cancel"))
            wish = MovieWish::give_up;
        tip("stop and delete the movie");
        ImGui::TextUnformatted(model.movies.words.c_str());
        return wish;
    }
    WrittenPictures pictures = model.asked.pictures;
    const auto steps = static_cast<std::uint32_t>(model.asked.known_steps(model.info.steps()));
    const interaction::StepRange& range = model.asked.play_range;
    text_row("steps",
             fmt::format("{} to {}", first_of(range, steps) + 1, last_of(range, steps) + 1));
    tip("the range that plays: drag its ends in the time bar");
    const interaction::PlaybackState& played = model.asked.playback;
    const std::span<const double> times = std::span(model.info.times).first(steps);
    const interaction::StepTrack track(times, range, played);
    const double seconds = std::max(track.duration() / interaction::track_rate(played, times),
                                    track.places() / pictures.rate);
    text_row("length", fmt::format("{:.4g} s, {:.0f} pictures", seconds, seconds * pictures.rate));
    tip("at the playback speed, or longer where each step needs a picture");
    row("rate");
    ImGui::SetNextItemWidth(kField);
    number_field("##rate", pictures.rate,
                 {.low = interaction::kSlowestMovie, .high = interaction::kFastestMovie},
                 "%.4g pictures a second");
    size_rows(pictures);
    folder_row(pictures);
    text_row("", model.movies.words);
    keep(model, pictures, commands);
    wish = key_row(model, commands);
    ImGui::BeginDisabled(steps < 2);
    if (ImGui::Button("these steps, this view"))
        wish = MovieWish::series;
    ImGui::EndDisabled();
    tip("a movie of these steps with this view, at the playback speed");
    ImGui::SameLine();
    ImGui::BeginDisabled(model.asked.views.size() < 2);
    if (ImGui::Button("along the viewpoints"))
        wish = MovieWish::views;
    ImGui::EndDisabled();
    tip(model.asked.views.size() < 2
            ? "a film along viewpoints needs two that are saved (B)"
            : "a movie from each saved viewpoint to the next, at one speed");
    if (ImGui::Button("one turn"))
        wish = MovieWish::turn;
    tip("a movie of 10 s: one turn about the data's up axis, while this moment stands");
    ImGui::SameLine();
    ImGui::BeginDisabled(steps < 2);
    if (ImGui::Button("one turn while time plays"))
        wish = MovieWish::both;
    ImGui::EndDisabled();
    tip("a movie of 10 s: one turn about the data's up axis, while these steps pass");
    ImGui::BeginDisabled(!model.movies.recorded);
    if (ImGui::Button("recording so far"))
        wish = MovieWish::recording;
    ImGui::EndDisabled();
    tip(model.movies.recorded ? "a movie of this session so far"
                              : "a movie of this session: press the record button first");
    return wish;
}

} // namespace isochron::app
