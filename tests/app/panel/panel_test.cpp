// The panel without a window can be laid out, whatever the names and values of the data.
#include "app/config/config.h"
#include "app/panel/panel.h"
#include "app/panel/panel_statistics.h"
#include "app/panel/parts/histogram.h"
#include "app/panel/parts/surfaces_section.h"
#include "app/panel/parts/theme.h"
#include "app/panel/parts/written_pictures.h"
#include "app/text.h"
#include "tests/app/panel/drawn_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

class PanelTest : public testing::Test {
  protected:
    PanelTest() : imgui_(ImGui::CreateContext()) {
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {1280, 800};
        use_theme(Theme::dark);
        use_measures();
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
        info_.times = {0, 1};
        stats_.histogram.assign(256, 1);
    }
    ~PanelTest() override { ImGui::DestroyContext(imgui_); }

    /// Three frames with the mouse at a place, pressed in the last: a window is there once laid
    /// out.
    interaction::Commands press(float x, float y) {
        interaction::Commands commands;
        for (const bool down : {false, false, true}) {
            ImGui::GetIO().MousePos = {x, y};
            ImGui::GetIO().MouseDown[0] = down;
            ImGui::NewFrame();
            PanelView view;
            PanelPages pages;
            commands = draw_panel({.info = info_,
                                   .stats = stats_,
                                   .asked = asked_,
                                   .frame = frame_,
                                   .controls = controls_},
                                  view, pages);
            ImGui::Render();
        }
        return commands;
    }

    /// Presses in the middle of the histogram.
    interaction::Commands press_on_histogram() { return press(150.0f, 260.0f); }

    ImGuiContext* imgui_;
    index::SeriesInfo info_;
    index::IndexStats stats_;
    ExplorerState asked_;
    FrameReport frame_;
    std::vector<interaction::ControlGroup> controls_{
        {interaction::DeviceKind::hands, {"Up Down   isovalue by 100 % of %s"}}};
};

TEST_F(PanelTest, TakesUnitsAsTextAndNotAsFormats) {
    stats_.low = 0;
    stats_.high = 100;
    for (const char* unit : {"%", "% signal change", "%s", "%n", "%%", "%5.1f%", "mm\xc2\xb2 s%"}) {
        info_.value_unit = info_.time_unit = info_.length_unit = info_.array = unit;
        const auto commands = press_on_histogram();
        ASSERT_TRUE(commands.isovalue.has_value()) << unit;
        EXPECT_NEAR(*commands.isovalue, 50, 5) << unit;
    }
}

TEST_F(PanelTest, TakesValuesUpToTheGreatestOfADouble) {
    constexpr double kMost = std::numeric_limits<double>::max();
    const double ranges[][2]{{-kMost, kMost}, {0, kMost},  {kMost, kMost},
                             {-kMost, 0},     {0, 5e-324}, {0, 0}};
    for (const auto& [low, high] : ranges) {
        stats_.low = low;
        stats_.high = high;
        const double first = quantile(stats_, kFirstQuantile);
        EXPECT_TRUE(low <= first && first <= high) << low << " to " << high;
        asked_.set_isovalue(first);
        const auto commands = press_on_histogram();
        EXPECT_EQ(commands.isovalue.has_value(), high / 2 > low / 2);
        EXPECT_TRUE(!commands.isovalue ||
                    (low <= *commands.isovalue && *commands.isovalue <= high));
    }
}

TEST(RangeText, HasAsManyDigitsAsTellItsEndsApart) {
    struct Row {
        double low, high;
        const char* words;
    };
    for (const Row& row :
         {Row{293.1499938964844, 353.141, "293.15 to 353.141 K"},
          Row{99960, 102725, "99960 to 102725 K"}, Row{102725, 99960, "102725 to 99960 K"},
          Row{101325.011, 101325.0148, "101325.011 to 101325.0148 K"},
          Row{0, 0.0034, "0 to 0.0034 K"}, Row{-5, 5, "-5 to 5 K"}, Row{7, 7, "7 to 7 K"},
          Row{1e-12, 2.5e12, "1e-12 to 2.5e+12 K"}, Row{-1e300, 1e300, "-1e+300 to 1e+300 K"}})
        EXPECT_EQ(range_text(row.low, row.high, "K"), row.words);
    const double largest = std::numeric_limits<double>::max();
    EXPECT_EQ(range_text(-largest, largest), "-1.79769e+308 to 1.79769e+308");
    index::SeriesInfo info;
    info.value_unit = "K";
    const double low = 284.8404235839844, high = 289.36212158203125; // floats
    EXPECT_EQ(exact_range_text(low, high, info), "284.84042 to 289.36212 K");
    info.type = index::ValueType::f64;
    EXPECT_EQ(exact_range_text(low, high, info), "284.8404235839844 to 289.36212158203125 K");
}

TEST_F(PanelTest, SaysTheSizesOfABoxInTheSameDecimals) {
    struct Row {
        std::array<double, 3> lengths;
        const char* words;
    };
    for (const Row& row :
         {Row{{0.88562, 0.8856, 0.88569}, "0.886 x 0.886 x 0.886 m"},
          Row{{20, 19.99998, 20}, "20 x 20 x 20 m"},
          Row{{1.35, 1.35, 0.0894}, "1.350 x 1.350 x 0.089 m"}, Row{{63, 63, 20}, "63 x 63 x 20 m"},
          Row{{1.5, 2, 3}, "1.5 x 2.0 x 3.0 m"},
          Row{{1234.5, 12, 0.25}, "1234.50 x 12.00 x 0.25 m"}, Row{{0, 4, 4}, "0 x 4 x 4 m"},
          Row{{0, 0, 0}, "0 x 0 x 0 m"}, Row{{2e7, 2e7, 1e-9}, "2e+07 x 2e+07 x 1e-09 m"},
          Row{{3.26e-9, 3.26e-9, 3e-9}, "3.26e-09 x 3.26e-09 x 3e-09 m"}})
        EXPECT_EQ(lengths_text(row.lengths, "m"), row.words);
    EXPECT_EQ(lengths_text({1, 1, 1}, ""), "1 x 1 x 1");
}

TEST_F(PanelTest, SaysHowManyValuesAreMissing) {
    info_.grid.vertices = {10, 10, 50}; // 10,000 values in two steps
    for (const auto& [missing, words] : {std::pair{0u, ""},
                                         {1u, "< 0.1 %"},
                                         {9u, "< 0.1 %"},
                                         {10u, "0.1 %"},
                                         {375u, "3.8 %"},
                                         {9'999u, "99.9 %"},
                                         {10'000u, "100 %"}}) {
        EXPECT_EQ(missing_text(missing, info_), words);
        stats_.nan_values = missing;
        press(5, 5);
        EXPECT_EQ(place_of_text(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts->Fonts.front(),
                                std::string(words) + ": holes there")
                      .has_value(),
                  missing > 0)
            << words;
    }
}

TEST_F(PanelTest, ColumnsOfWholeNumbersLeaveNoGaps) {
    const auto counts = [&](index::ValueType type, double low, double high,
                            const std::vector<std::pair<std::size_t, std::uint64_t>>& bins) {
        info_.type = type;
        stats_.low = low;
        stats_.high = high;
        stats_.histogram.assign(256, 0);
        for (const auto& [bin, count] : bins)
            stats_.histogram[bin] = count;
        return column_counts({.info = info_,
                              .stats = stats_,
                              .asked = asked_,
                              .frame = frame_,
                              .controls = controls_});
    };
    // 5, 6 and 7, of which no 6 is there; then one is.
    std::vector<std::uint64_t> wanted(256, 0);
    std::fill_n(wanted.begin(), 128, 30);
    wanted.back() = 7;
    EXPECT_EQ(counts(index::ValueType::u8, 5, 7, {{0, 30}, {255, 7}}), wanted);
    std::fill_n(wanted.begin() + 128, 127, 4);
    EXPECT_EQ(counts(index::ValueType::u8, 5, 7, {{0, 30}, {128, 4}, {255, 7}}), wanted);
    info_.scaling.slope = -0.5; // three numbers again, half as far apart
    EXPECT_EQ(counts(index::ValueType::i16, 5, 6, {{0, 30}, {128, 4}, {255, 7}}), wanted);
    info_.scaling.slope = 1;
    // 253 numbers, one in each of 253 bins of 256.
    std::vector<std::pair<std::size_t, std::uint64_t>> all;
    for (std::size_t i = 0; i < 252; ++i)
        all.emplace_back(i * 256 / 252, 1);
    all.emplace_back(255, 1);
    EXPECT_EQ(counts(index::ValueType::u8, 0, 252, all), std::vector<std::uint64_t>(256, 1));
    EXPECT_EQ(counts(index::ValueType::f32, 0, 252, all), stats_.histogram) << "gaps are real";
    EXPECT_EQ(counts(index::ValueType::u16, 0, 300, all), stats_.histogram) << "more than bins";
}

TEST_F(PanelTest, MeasurementsAreSaidInWords) {
    info_.grid.vertices = {11, 21, 6};
    info_.length_unit = "mm";
    frame_.cells = 4321;
    frame_.candidates = 9000;
    frame_.reused = 17;
    frame_.tracking = {{.name = "head", .tracking = interaction::Tracking::lost}};
    PanelModel model{.info = info_,
                     .stats = stats_,
                     .asked = asked_,
                     .frame = frame_,
                     .work = {.frames = {.times = {}, .per_second = 59.6},
                              .reading = {.bytes = 1 << 21, .held = 1 << 20, .budget = 1 << 30}},
                     .notes = {.failure = "the disk is gone"},
                     .controls = controls_};
    const auto said = [&] {
        ImGui::NewFrame();
        ImGui::SetNextWindowSize({600, 400});
        ImGui::Begin("panel");
        ImGui::LogToClipboard();
        measurements(model);
        complaints(model);
        ImGui::LogFinish();
        ImGui::End();
        ImGui::Render();
        return std::string(ImGui::GetClipboardText());
    };
    said(); // a window is there once laid out
    const std::string text = said();
    for (const char* words :
         {"4321 cells", "of 9000 candidates, 17 reused", "volume 10 x 20 x 5 mm", "60 frames/s",
          "cache 1.00 MiB of 1.00 GiB", "head", "the disk is gone"})
        EXPECT_THAT(text, testing::HasSubstr(words));
    model.work.searching = true;
    EXPECT_THAT(said(), testing::HasSubstr("searching ..."));
}

/// The part on movies alone, of which every place is clicked.
class MovieButtons : public PanelTest {
  protected:
    std::optional<MovieWish> frame(float x, float y, bool down) {
        ImGui::GetIO().MousePos = {x, y};
        ImGui::GetIO().MouseDown[0] = down;
        ImGui::NewFrame();
        ImGui::SetNextWindowPos({0, 0});
        ImGui::SetNextWindowSize({380, 300});
        ImGui::Begin("panel");
        interaction::Commands commands;
        const auto wish = movie_rows({.info = info_,
                                      .stats = stats_,
                                      .asked = asked_,
                                      .frame = frame_,
                                      .movies = movies_,
                                      .controls = controls_},
                                     commands);
        ImGui::End();
        ImGui::Render();
        return wish;
    }
    std::set<MovieWish> wishes() {
        std::set<MovieWish> all;
        for (int y = 25; y < 300; y += 6)
            for (int x = 10; x < 380; x += 20)
                for (const bool down : {false, false, true, false})
                    if (const auto wish = frame(float(x), float(y), down))
                        all.insert(*wish);
        return all;
    }

    MovieState movies_{.offered = true, .recorded = true};
};

TEST_F(MovieButtons, AskForAMovieOfTheRecordingOrOfTheSeriesWhereThereIsOne) {
    using enum MovieWish;
    EXPECT_EQ(wishes(), (std::set{recording, series, turn, both}));
    movies_.recorded = false;
    EXPECT_EQ(wishes(), (std::set{series, turn, both}));
    info_.times = {0};
    EXPECT_EQ(wishes(), std::set{turn});
}

TEST_F(MovieButtons, AMovieThatIsBeingMadeCanOnlyBeGivenUp) {
    movies_.progress = 0.5f;
    EXPECT_EQ(wishes(), std::set{MovieWish::give_up});
}

TEST(NewSurfaces, WhatLiesAroundThemGivesWayAndNothingElse) {
    using interaction::Isosurface;
    const auto opacities = [](std::vector<Isosurface> surfaces, std::size_t added) {
        let_see(surfaces, added);
        std::vector<bool> translucent;
        for (const Isosurface& surface : surfaces)
            translucent.push_back(surface.opacity < 1.0f);
        return translucent;
    };
    const auto at = [](double isovalue) { return Isosurface{isovalue, glm::vec3(1), 1.0f}; };
    // Around all others; inside all others; between two.
    EXPECT_EQ(opacities({at(5), at(9), at(2)}, 2), (std::vector{false, false, true}));
    EXPECT_EQ(opacities({at(5), at(2), at(9)}, 2), (std::vector{true, true, false}));
    EXPECT_EQ(opacities({at(2), at(9), at(5)}, 2), (std::vector{true, false, true}));
    EXPECT_EQ(opacities({at(5)}, 0), std::vector{false});
    EXPECT_EQ(opacities({at(5), at(5)}, 1), (std::vector{false, false})) << "neither is outside";
    // What is translucent already stays as it is.
    std::vector<Isosurface> surfaces{at(2), at(9)};
    surfaces[0].opacity = 0.1f;
    let_see(surfaces, 1);
    EXPECT_EQ(surfaces[0].opacity, 0.1f);
    EXPECT_EQ(surfaces[1].opacity, 1.0f);
}

} // namespace
} // namespace isochron::app
