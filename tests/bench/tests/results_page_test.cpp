// The page of results is the one that the committed figures give, and says what they say.
#include "index/error.h"
#include "tests/bench/measures/artifacts.h"
#include "tests/bench/pages/bar_chart.h"
#include "tests/bench/pages/change_page.h"
#include "tests/bench/pages/first_page.h"
#include "tests/bench/pages/goals.h"
#include "tests/bench/pages/render_goals.h"
#include "tests/bench/pages/render_page.h"
#include "tests/bench/pages/results_page.h"
#include "tests/support/paths.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

namespace isochron::bench {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

std::string read(const std::string& path) {
    std::ifstream file(test_support::source_root() + "/" + path, std::ios::binary);
    EXPECT_TRUE(file) << path;
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The name of a file of results; empty where it is not there.
std::string if_committed(const std::string& path) {
    return std::filesystem::exists(test_support::source_root() + "/" + path) ? path : "";
}

const ResultPaths& committed_results() {
    static const ResultPaths paths{.index = "docs/results/index.json",
                                   .render = "docs/results/render.json",
                                   .artifacts = "docs/results/artifacts.json",
                                   .scale = "docs/results/scale.txt",
                                   .gpu = "docs/results/gpu.txt",
                                   .agreement = "docs/results/agreement.json",
                                   .motion = "docs/results/motion.json",
                                   .building = if_committed("docs/results/building.json"),
                                   .change = if_committed("docs/results/change.json"),
                                   .between = if_committed("docs/results/between.json"),
                                   .public_files = "docs/results/public.txt"};
    return paths;
}

TEST(ResultsPage, IsTheOneOfTheCommittedFigures) {
    const ResultPaths& paths = committed_results();
    const ResultsPage page = whole_page(paths, read);
    const std::string how = "make it again: ./run bench results " + paths.index + " --render " +
                            paths.render + " --artifacts " + paths.artifacts + " --scale " +
                            paths.scale + " --gpu " + paths.gpu + " --agreement " +
                            paths.agreement + " --motion " + paths.motion +
                            (paths.building.empty() ? "" : " --building " + paths.building) +
                            (paths.change.empty() ? "" : " --change " + paths.change) +
                            (paths.between.empty() ? "" : " --between " + paths.between) +
                            " --public " + paths.public_files + " -o docs/RESULTS.md";
    EXPECT_EQ(page.text, read("docs/RESULTS.md")) << how;
    for (const auto& [name, chart] : page.charts)
        EXPECT_EQ(chart, read("docs/" + name)) << how;
    for (const Header& header : {results_from_json(read(paths.index), "").header,
                                 render_results_from_json(read(paths.render), "").header,
                                 artifacts_from_json(read(paths.artifacts), "").header}) {
        EXPECT_FALSE(header.commit.empty());
        EXPECT_FALSE(header.processor.empty());
    }
}

TEST(ResultsPage, ShowsOnlyPicturesThatAreThere) {
    const std::string page = read("docs/RESULTS.md");
    const std::regex picture(R"(!\[[^\]]*\]\(([^)]+)\))");
    int shown = 0;
    for (std::sregex_iterator i(page.begin(), page.end(), picture), end; i != end; ++i, ++shown)
        EXPECT_TRUE(std::filesystem::exists(test_support::source_root() + "/docs/" + (*i)[1].str()))
            << (*i)[1];
    EXPECT_GE(shown, 3);
}

TEST(ResultsPage, BeginsWithTenFiguresThatNameTheirSource) {
    const std::string page = whole_page(committed_results(), read).text;
    const std::string first = page.substr(0, page.find("\n# ", 1));
    const auto count = [&](const char* pattern) {
        const std::regex wanted(pattern);
        return std::distance(std::sregex_iterator(first.begin(), first.end(), wanted), {});
    };
    EXPECT_THAT(first, StartsWith("# What to expect: 10 figures\n"));
    EXPECT_EQ(count("\n## "), 10);
    EXPECT_EQ(count(R"(\n!\[[^\]]+\]\(pictures/charts/\w+\.svg\)\n)"), 10);
    EXPECT_EQ(count(R"(\n\*From `docs/results/\w+\.(json|txt)`, .{20,}\.\*\n)"), 10);
    EXPECT_THAT(first, AllOf(HasSubstr("**The machines.**"), HasSubstr("**Not measured.**")));
}

TEST(FirstPage, LeavesOutWhatWasNotMeasured) {
    EXPECT_TRUE(figures_of({}).empty());
    EXPECT_EQ(first_page({}, "charts"), "");
    FirstPageInput input;
    input.names.scale = "s.txt";
    input.scale = "commit 0123, a processor\n"
                  "smooth 512^3 u8, codec fitting: index / data 0.5, build 0.25 s of processor "
                  "time, 1x zstd -1\n";
    const std::vector<PageFigure> figures = figures_of(input);
    ASSERT_EQ(figures.size(), 2u);
    EXPECT_EQ(figures[0].chart.bars[0].text, "0.5");
    EXPECT_EQ(figures[1].chart.bars[0].text, "2.0 s"); // a GiB is eight times as much
    EXPECT_THAT(first_page(figures, "charts"),
                AllOf(HasSubstr("*From `s.txt`, commit 0123, a processor.*"),
                      HasSubstr("](charts/index_size.svg)")));
}

TEST(BarChart, DrawsLengthsInProportionAndEscapesItsWords) {
    const BarChart chart{.title = "a < b",
                         .bars = {{"one", 1, "1 ms", true}, {"four", 4, "4 & more", false}}};
    const std::string svg = svg_of(chart);
    EXPECT_THAT(svg, AllOf(HasSubstr("<title>a &lt; b</title>"), HasSubstr("4 &amp; more"),
                           HasSubstr("width=\"82.5\""), HasSubstr("width=\"330.0\"")));
    EXPECT_EQ(svg.find("http", svg.find("viewBox")), std::string::npos); // asks for nothing
}

TEST(BarChart, MarksAValueAndShowsSmallBarsOfALogarithm) {
    const BarChart chart{.title = "t",
                         .bars = {{"little", 1, "1", true}, {"much", 1000, "1000", false}},
                         .logarithmic = true,
                         .mark = 1000,
                         .mark_text = "the budget"};
    const std::string svg = svg_of(chart);
    EXPECT_THAT(svg, AllOf(HasSubstr("width=\"30.1\""), HasSubstr("width=\"330.0\""),
                           HasSubstr("x1=\"620.0\""), HasSubstr("the budget")));
}

Row row_of(const std::string& structure, const std::string& data, const std::string& type) {
    Row row;
    row.structure = structure;
    row.data = data;
    row.type = type;
    row.steps = 25;
    return row;
}

Results results_of(const std::vector<Row>& rows) {
    Results results{{"0123abcd", "some processor", "some compiler", "2026-01-01", 2}, rows, {}};
    results.details.resize(rows.size());
    return results;
}

TEST(ResultsPage, PutsThePublishedFiguresNextToOurs) {
    Row row = row_of("thi", "sphere", "u8");
    row.l = 64;
    row.max_variation = 2;
    row.percent_of_raw = 12.34;
    row.search_ids_us = 8;
    row.sweep_ms = 0.08;
    Results results = results_of({row});
    results.details[0].percent_at_isovalue = 10.6;
    const std::string page =
        results_page(results, {.index = "a.json", .render = {}, .artifacts = {}, .scale = {}});
    EXPECT_THAT(page, HasSubstr("commit 0123abcd, some compiler, on some processor"));
    // Table 1 and Table 2 share this setting; others were not measured.
    EXPECT_THAT(page, HasSubstr("| 64 | 2 | 25 | paper | 37.2 | 1.3 | 2140 | 740 | 2.90 |\n"
                                "| | | | u8 here | 12.3 | 11 | 8 | 3.2 | 2.50 |\n"
                                "| | | | f32 here | - | - | - | - | - |\n"));
    EXPECT_THAT(page, HasSubstr("| 64 | 1 | 55 | paper | 107.6 | 0.08 | 2320 | 830 | 2.79 |\n"
                                "| | | | u8 here | - | - | - | - | - |\n"));
}

TEST(Goals, AreDecidedByTheWorstRow) {
    Row first = row_of("cells", "sphere", "u8"), second = first;
    first.percent_of_raw = 4.4;
    second.steps = 55;
    second.percent_of_raw = 4.5;
    const auto table = [&] { return goals_table(results_of({first, second})); };
    EXPECT_THAT(table(), HasSubstr("| 4.5 % | 7 % | 4.4 to 4.5 % | goal reached |"));
    second.percent_of_raw = 6.9;
    EXPECT_THAT(table(), HasSubstr("| 4.4 to 6.9 % | above the floor |"));
    second.percent_of_raw = 7.1;
    EXPECT_THAT(table(), HasSubstr("| 4.4 to 7.1 % | **below the floor** |"));
}

TEST(Goals, SpeakOfSpeedTheOtherWayRound) {
    Row row = row_of("cells", "sphere", "u8");
    row.search_ids_us = 2;
    row.flying_edges_us = 1000;
    EXPECT_THAT(goals_table(results_of({row})), HasSubstr("| 500x | 100x | 500x | goal reached |"));
    row.flying_edges_us = 150;
    EXPECT_THAT(goals_table(results_of({row})), HasSubstr("| 75x | **below the floor** |"));
    EXPECT_THAT(goals_table(results_of({})), HasSubstr("| 500x | 100x | - | not measured |"));
}

TEST(Goals, LetOnlyThePublishedStructureHaveFalsePositives) {
    Row thi = row_of("thi", "sphere", "u8"), cells = row_of("cells", "sphere", "u8");
    thi.false_positives = 1000;
    EXPECT_THAT(goals_table(results_of({thi, cells})), HasSubstr("| 0 | 0 | 0 | goal reached |"));
    cells.false_negatives = 1;
    EXPECT_THAT(goals_table(results_of({thi, cells})),
                HasSubstr("| 0 | 0 | 1 | **below the floor** |"));
}

RenderRow render_row(const std::string& footprint, double fps) {
    RenderRow row;
    row.data = "sphere";
    row.footprint = footprint;
    row.size = 512;
    row.threads = 2;
    row.fps = fps;
    row.p99_over_static = 1.4;
    return row;
}

TEST(RenderPage, PutsTheRatesNextToThePaper) {
    RenderRow one_core = render_row("quad", 300.4);
    one_core.threads = 1;
    const std::string page = render_section(
        {{"0123abcd", "p", "c", "d", 2}, {render_row("quad", 612.4), one_core}}, "b.json");
    EXPECT_THAT(page, HasSubstr("| fast | paper, GeForce 4 | 250.85 | 284.42 |\n"
                                "| | here, software GL, 1 core | 300 | - |\n"
                                "| | here, software GL, 2 cores | 612 | - |\n"));
    EXPECT_THAT(page, HasSubstr("| sphere | quad | 512^2 | 2 |"));
}

TEST(RenderGoals, SpeakOfTwoCoresAndOnePicture) {
    RenderRow row = render_row("quad", 500);
    const auto table = [&] { return render_goals_table({row}); };
    EXPECT_THAT(table(), HasSubstr("| 600 fps | 250 fps | 500 fps | above the floor |"));
    row.draw_ms = 2;
    row.quads_ms = 2.8;
    row.bare_fps = 500;
    EXPECT_THAT(table(), HasSubstr("those that are seen, against all bare quads, 512^2 | 1.1x | "
                                   "1.3x | 1x | goal reached |"));
    EXPECT_THAT(table(), HasSubstr("all of them, against bare quads, 512^2 | 1.1x | 1.3x | "
                                   "1.4x | **below the floor** |"));
    EXPECT_THAT(table(), HasSubstr("| 1.3x | 2x | 1.4x | above the floor |"));
    row.sent_ids_percent = 10.8;
    EXPECT_THAT(table(), HasSubstr("of all, sphere | 20 % | 40 % | 10.8 % | goal reached |"));
    row.threads = 1;
    EXPECT_THAT(table(), HasSubstr("fast quads, sphere, 512^2 | 600 fps | 250 fps | - |"));
}

TEST(ChangePage, HasARowForEachTypeAndEachChange) {
    const std::string building = R"({"commit": "c", "processor": "p", "size": 64, "rows": [{
        "what": "f32, smooth", "index_over_data": 0.75, "zstd_over_data": 0.875,
        "build_seconds": 0.05, "zstd_seconds": 0.025, "over_zstd": 2.0}]})";
    EXPECT_THAT(building_section(building, "b.json"),
                HasSubstr("| f32, smooth | 0.750 | 0.875 | 50.0 | 25.0 | 2.00 |"));
    const std::string change = R"({"commit": "c", "processor": "p", "load": "1.0", "rows": [{
        "what": "90 % stay", "use": "with planes", "again": true, "cells": 90, "kept_ms": 1.5,
        "anew_ms": 3, "alone_ms": 6, "over_anew": 0.5, "over_alone": 0.25, "floor": 0.35}]})";
    EXPECT_THAT(change_section(change, "c.json"),
                HasSubstr("| 90 % stay | with planes | again | 90 | 1.50 | 0.50 | 0.25 | 0.35 |"));
    EXPECT_THROW(change_section(building, "b.json"), index::Error);
}

TEST(RenderGoals, CompareASurfaceWithSplatsOfTheSamePicture) {
    RenderRow surface = render_row("surface", 90), splats = render_row("gaussian", 100);
    surface.size = splats.size = 1024;
    surface.draw_ms = 6;
    splats.draw_ms = 10;
    EXPECT_THAT(render_goals_table({splats, surface}),
                HasSubstr("| 0.7x | 1.3x | 0.6x | goal reached |"));
    EXPECT_THAT(render_goals_table({surface}), HasSubstr("| 0.7x | 1.3x | - | not measured |"));
}

} // namespace
} // namespace isochron::bench
