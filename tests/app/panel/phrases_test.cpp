// Phrases that newcomers type into the search of commands lead to the control that they want.
#include "app/panel/search_rank.h"
#include "tests/app/panel/searched_session.h"
#include "tests/support/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::app {
namespace {

struct Phrase {
    std::string typed, wanted;
    std::vector<std::string> controls; ///< any of them answers; empty: none does
};
/// @param name `phrases`: of newcomers; `phrases_held_out` and `phrases_peers`: typed by users of other programs, and
/// written before the names of controls were read
std::vector<Phrase> phrases(const std::string& name) {
    std::ifstream file(test_support::source_root() + "/tests/app/panel/" + name + ".tsv");
    std::vector<Phrase> all;
    for (std::string line; std::getline(file, line);) {
        std::istringstream columns(line);
        Phrase phrase;
        std::string controls;
        std::getline(columns, phrase.typed, '\t');
        std::getline(columns, phrase.wanted, '\t');
        std::getline(columns, controls);
        std::istringstream each(controls);
        for (std::string control; std::getline(each, control, '|');)
            if (control != "-")
                phrase.controls.push_back(control);
        all.push_back(std::move(phrase));
    }
    return all;
}

/// A control answers itself, and so does any value of it: `color_by=temperature`.
bool answers(const SearchLine& line, const Phrase& phrase) {
    return std::ranges::any_of(phrase.controls, [&](const std::string& control) {
        return line.name == control || line.name.starts_with(control + "=");
    });
}

class Phrases : public testing::TestWithParam<const char*> {};

TEST_P(Phrases, FindTheirControlAmongTheFirstThreeLines) {
    constexpr std::size_t kFirst = 3;
    // What nobody has looked at while the search was made is found less often.
    const double kFloor = std::string_view(GetParam()) == "phrases_peers_held_out" ? 0.75 : 0.85;
    constexpr double kMostWithout = 0.12;
    Searched session;
    const std::vector<SearchLine> lines = session.lines();
    std::size_t found = 0, without = 0, answered = 0;
    const std::vector<Phrase> all = phrases(GetParam());
    ASSERT_GE(all.size(), 37u);
    for (const Phrase& phrase : all) {
        const Ranking ranking = ranked(lines, phrase.typed);
        const std::size_t first = std::min(kFirst, ranking.lines.size());
        std::string names;
        for (std::size_t i = 0; i < first; ++i)
            names += ranking.lines[i]->name + " ";
        if (phrase.controls.empty()) {
            ++without;
            EXPECT_FALSE(ranking.lines.empty()) << phrase.typed;
            answered += ranking.only_near;
            std::cout << "no control: " << phrase.typed << ": " << names
                      << (ranking.only_near ? "(near)" : "") << '\n';
            continue;
        }
        const bool right = std::any_of(ranking.lines.begin(), ranking.lines.begin() + first,
                                       [&](const auto* line) { return answers(*line, phrase); });
        found += right;
        if (!right)
            std::cout << "not found: " << phrase.typed << " (" << phrase.wanted
                      << "), but: " << names << '\n';
    }
    const std::size_t with = all.size() - without;
    std::cout << found << " of " << with << " phrases found, " << answered << " of " << without
              << " said to be unknown\n";
    EXPECT_GE(double(found), kFloor * double(with));
    EXPECT_LE(double(without), kMostWithout * double(all.size()));
}

TEST_P(Phrases, NameControlsThatHaveALine) {
    Searched session;
    const std::vector<SearchLine> lines = session.lines();
    for (const Phrase& phrase : phrases(GetParam()))
        EXPECT_TRUE(phrase.controls.empty() ||
                    std::ranges::any_of(
                        lines, [&](const SearchLine& line) { return answers(line, phrase); }))
            << phrase.typed;
}

INSTANTIATE_TEST_SUITE_P(Lists, Phrases,
                         testing::Values("phrases", "phrases_held_out", "phrases_peers",
                                         "phrases_peers_held_out"));

} // namespace
} // namespace isochron::app
