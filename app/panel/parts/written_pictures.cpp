// What pictures and movies that are written show, and their size.
#include "app/panel/parts/written_pictures.h"

#include "app/panel/imgui/number_entry.h"
#include "app/panel/panel_words.h"
#include "app/panel/parts/rows.h"
#include "app/panel/parts/theme.h"
#include "interaction/step_track.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <string>
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
    static const std::vector<std::string> kWords{"as in the window", "white", "transparent"};
    row("background");
    ImGui::SetNextItemWidth(kField);
    if (const auto chosen =
            choice_field("##background", kWords[static_cast<std::size_t>(pictures.background)],
                         kWords, "behind the data; words and lines on white are dark"))
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

std::optional<MovieWish> movie_rows(const PanelModel& model, interaction::Commands& commands) {
    std::optional<MovieWish> wish;
    if (model.movies.progress) {
        ImGui::ProgressBar(*model.movies.progress, {160.0f, 0.0f});
        ImGui::SameLine();
        if (ImGui::Button("Cancel"))
            wish = MovieWish::give_up;
        tip("stop and delete the movie");
        return wish;
    }
    WrittenPictures pictures = model.asked.pictures;
    const auto steps = static_cast<std::uint32_t>(model.asked.known_steps(model.info.steps()));
    const interaction::StepRange& range = model.asked.play_range;
    text_row("steps",
             fmt::format("{} to {}", first_of(range, steps) + 1, last_of(range, steps) + 1));
    tip("the range that plays: drag its ends in the time bar");
    row("rate");
    ImGui::SetNextItemWidth(kField);
    number_field("##rate", pictures.rate,
                 {.low = interaction::kSlowestMovie, .high = interaction::kFastestMovie},
                 "%.4g pictures a second");
    size_rows(pictures);
    folder_row(pictures);
    keep(model, pictures, commands);
    ImGui::BeginDisabled(steps < 2);
    if (ImGui::Button("these steps, this view"))
        wish = MovieWish::series;
    ImGui::EndDisabled();
    tip("a movie of these steps with this view, at the playback speed");
    ImGui::SameLine();
    ImGui::BeginDisabled(!model.movies.recorded);
    if (ImGui::Button("recording so far"))
        wish = MovieWish::recording;
    ImGui::EndDisabled();
    tip(model.movies.recorded ? "a movie of this session so far"
                              : "a movie of this session: press the record button first");
    return wish;
}

} // namespace isochron::app
