// The page of results is the one that the committed figures give, and says what they say.
#include "app/bench/goals.h"
#include "app/bench/results_page.h"

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

namespace isochron::app::bench {
namespace {

using testing::HasSubstr;

std::string read(const std::string& path) {
    std::ifstream file(std::string(SOURCE_ROOT) + "/" + path, std::ios::binary);
    EXPECT_TRUE(file) << path;
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(ResultsPage, IsTheOneOfTheCommittedFigures) {
    const std::string source = "docs/results/index.json";
    const Results results = results_from_json(read(source), source);
    EXPECT_EQ(results_page(results, source), read("docs/RESULTS.md"))
        << "make it again: isochron bench results " << source << " -o docs/RESULTS.md";
    EXPECT_FALSE(results.header.commit.empty());
    EXPECT_FALSE(results.header.processor.empty());
}

Row row_of(const std::string& structure, const std::string& data, const std::string& type) {
    Row row;
    row.structure = structure;
    row.data = data;
    row.type = type;
    row.steps = 25;
    return row;
}

Results results_of(std::vector<Row> rows) {
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
    const std::string page = results_page(results, "a.json");
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

} // namespace
} // namespace isochron::app::bench
