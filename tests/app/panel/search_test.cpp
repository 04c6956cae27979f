// The lines of the search: what they set, and how they are ranked.
#include "app/panel/parts/sections.h"
#include "app/panel/search_rank.h"
#include "tests/app/panel/searched_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace isochron::app {
namespace {

using interaction::Commands;

/// The first line for a text, with what its number leads to.
struct First {
    std::string name, words;
    Commands commands;
};
First first(Searched& session, std::string_view text) {
    const std::vector<SearchLine> lines = session.lines();
    const Ranking found = ranked(lines, text);
    if (found.lines.empty())
        return {};
    const SearchLine& line = *found.lines.front();
    if (!found.number || !line.with_number)
        return {line.name, line.words, line.commands};
    const NumberEffect effect = line.with_number(*found.number);
    return {line.name, effect.words, effect.commands};
}

TEST(SearchLines, TakeNumbers) {
    Searched session;
    const struct {
        const char* text;
        const char* words; ///< value that the line shows
        std::function<bool(const ExplorerState&)> is_so;
    } rows[] = {
        {"opacity 40", "40 %", [](auto& s) { return s.isosurfaces[0].opacity == 0.4f; }},
        {"alpha 0.3", "30 %", [](auto& s) { return s.isosurfaces[0].opacity == 0.3f; }},
        {"transparency 70", "70 %",
         [](auto& s) { return std::abs(s.isosurfaces[0].opacity - 0.3f) < 1e-6f; }},
        {"isovalue 12.5", "12.5", [](auto& s) { return s.isovalue() == 12.5; }},
        {"threshold -3", "-3", [](auto& s) { return s.isovalue() == -3; }},
        {"step 30", "30 of 200", [](auto& s) { return s.instant == interaction::Instant(29); }},
        {"step 900", "200 of 200", [](auto& s) { return s.instant == interaction::Instant(199); }},
        {"t=2.5", "", [](auto& s) { return s.instant == interaction::Instant(5); }},
        {"time 1e9", "", [](auto& s) { return s.instant == interaction::Instant(199); }},
        {"time -1", "", [](auto& s) { return s.instant == interaction::Instant(0); }},
        {"ambient occlusion 25", "25 %", [](auto& s) { return s.look.occlusion == 0.25f; }},
        {"speed 2", "x 2", [](auto& s) { return s.playback.speed == 2; }},
        {"fps 10", "10 steps a second",
         [](auto& s) {
             return s.playback.unit == interaction::SpeedUnit::steps && s.playback.rate == 10;
         }},
        {"vertical exaggeration 3", "x 3",
         [](auto& s) { return s.room_from_physical.exaggeration == 3; }},
        {"zoom 2", "x 2", [](auto& s) { return s.room_from_physical.scale == 2; }},
        {"bands 7", "7", [](auto& s) { return s.coloring.bands == 7; }},
        {"eye separation 60", "60 mm", [](auto& s) { return s.eye_separation == 0.06f; }},
        {"ghosts 2", "2 earlier, 2 later",
         [](auto& s) { return s.ghosts == interaction::Ghosts{2, 2}; }},
        {"onion skin 9", "4 earlier, 4 later",
         [](auto& s) { return s.ghosts == interaction::Ghosts{4, 4}; }},
        {"trail 3", "3 earlier, 3 later",
         [](auto& s) { return s.ghosts == interaction::Ghosts{3, 3}; }},
        {"earlier steps 4", "4 earlier, 0 later",
         [](auto& s) { return s.ghosts == interaction::Ghosts{4, 0}; }},
        {"later ghosts 2", "1 earlier, 2 later",
         [](auto& s) { return s.ghosts == interaction::Ghosts{1, 2}; }},
        {"ghost spacing 8", "every 8 steps", [](auto& s) { return s.ghosts.every == 8; }},
        {"ghost opacity 40", "40 %", [](auto& s) { return s.ghosts.opacity == 0.4f; }},
    };
    Searched without;
    without.asked.ghosts = {};
    EXPECT_EQ(first(without, "ghosts 2").commands.ghosts, (interaction::Ghosts{2, 2}));
    for (const auto& row : rows) {
        const First found = first(session, row.text);
        ExplorerState state = session.asked;
        EXPECT_TRUE(state.apply(found.commands, session.info.steps())) << row.text;
        EXPECT_TRUE(row.is_so(state)) << row.text << ": " << found.name << " " << found.words;
        if (*row.words)
            EXPECT_EQ(found.words, row.words) << row.text;
    }
}

TEST(SearchLines, ShowThePresentValue) {
    Searched session;
    session.asked.isosurfaces[0].opacity = 0.25f;
    session.asked.look.background = interaction::Background::light;
    const auto value = [&](std::string_view name) {
        for (const SearchLine& line : session.lines())
            if (line.name == name)
                return line.value;
        return std::string("no line");
    };
    EXPECT_EQ(value("opacity"), "25 %");
    EXPECT_EQ(value("isovalue"), "40");
    EXPECT_EQ(value("background"), "light");
    EXPECT_EQ(value("step"), "1 of 200");
    EXPECT_EQ(value("legend"), "on");
    EXPECT_EQ(value("background=light"), "now") << "it is so already";
    EXPECT_EQ(value("background=dark"), "");
}

TEST(SearchLines, HaveCommandsThatChangeSomethingAndAreObeyed) {
    Searched session;
    for (const SearchLine& line : session.lines()) {
        const bool does = line.press || line.section || line.page != SearchPage::none || line.movie;
        ExplorerState state = session.asked;
        EXPECT_TRUE(state.apply(line.commands, session.info.steps())) << line.words;
        const bool changes = !(line.commands == Commands());
        EXPECT_TRUE(does || changes) << line.words;
        EXPECT_TRUE(!line.section || *line.section <= kSections) << line.words;
        for (const double number : {-1e300, -1.0, 0.0, 0.5, 1.0, 7.0, 1e300}) {
            if (!line.with_number)
                continue;
            ExplorerState numbered = session.asked;
            EXPECT_TRUE(numbered.apply(line.with_number(number).commands, session.info.steps()))
                << line.words << " " << number;
        }
    }
}

TEST(SearchLines, HaveOtherNamesOnlyForControls) {
    std::set<std::string> names;
    for (const bool box : {false, true}) { // it is shown or removed
        Searched session;
        session.asked.clip_box.shown = box;
        for (const SearchLine& line : session.lines()) {
            names.insert(line.name);
            names.insert(line.name.substr(0, line.name.find('='))); // one line for each choice
        }
    }
    names.insert("transparency"); // the other line of `opacity`
    std::set<std::string_view> rows;
    for (const std::string_view control : controls_with_other_names()) {
        EXPECT_TRUE(rows.insert(control).second) << control << " stands twice";
        const std::string setting(control.substr(0, control.find('=')));
        EXPECT_TRUE(names.contains(std::string(control)) ||
                    (control != setting && names.contains(setting)))
            << control;
    }
}

TEST(Ranked, AllWordsInAnyOrderCaseSpellingAndWithATypo) {
    Searched session;
    for (const auto& [text, name] : std::initializer_list<std::pair<const char*, const char*>>{
             {"projection PARALLEL", "orthographic"},
             {"screenshot", "screenshot"},
             {"redo", "redo"},
             {"Ctrl + Shift + Z", "redo"},
             {"colour map", "color_map"},
             {"backgrounds", "background"},
             {"bakground", "background"},
             {"transparancy", "opacity"},
             {"histogramm", "histogram"},
             {"inferno", "color_map=inferno"},
             {"color by: temperature", "color_by=temperature"},
             {"array pressure", "array=pressure"},
             {"top_bottom", "stereo=top_bottom"}})
        EXPECT_EQ(first(session, text).name, name) << text;
}

TEST(SearchLines, DoNotSayTheirValueTwice) {
    Searched session;
    for (const SearchLine& line : session.lines())
        if (line.value.size() > 4)
            EXPECT_EQ(line.words.find(line.value), std::string::npos) << line.words;
}

TEST(Ranked, KnowsWordsOfOtherProgramsAndPassesOverThoseThatNoneHas) {
    Searched session;
    for (const auto& [typed, name] : {std::pair{"delete fiducial", "remove_made"},
                                      {"xyzzy play", "play"},
                                      {"turn off the legend", "legend"},
                                      {"turn y 90", "turn"},
                                      {"ruler", "ruler_tool"},
                                      {"previous keyframe", "previous_key"}})
        EXPECT_EQ(first(session, typed).name, name) << typed;
}

TEST(Ranked, OffersTheNearestByLettersWhereNoWordIsFound) {
    Searched session;
    const std::vector<SearchLine> lines = session.lines();
    for (const auto& [text, name] :
         std::initializer_list<std::pair<const char*, const char*>>{{"opasitty", "opacity"},
                                                                    {"hystrogam", "histogram"},
                                                                    {"isolvaulue", "isovalue"},
                                                                    {"bookmrak", "save_time"},
                                                                    {"screnschot", "screenshot"},
                                                                    {"stereoscpoy", "stereo"}}) {
        const Ranking found = ranked(lines, text);
        const auto end =
            found.lines.begin() + std::min<long>(3, found.lines.end() - found.lines.begin());
        EXPECT_TRUE(
            std::any_of(found.lines.begin(), end,
                        [&](const SearchLine* line) { return line->name.starts_with(name); }))
            << text << ": " << found.lines.front()->name;
    }
}

TEST(Ranked, SaysWhenNothingHasTheWordsAndOffersThreeAndTheHelp) {
    Searched session;
    const std::vector<SearchLine> lines = session.lines();
    const Ranking nothing = ranked(lines, "quaternion polarimetry");
    EXPECT_TRUE(nothing.only_near);
    EXPECT_GE(nothing.lines.size(), 3u);
    EXPECT_LE(nothing.lines.size(), 4u);
    EXPECT_TRUE(std::ranges::any_of(nothing.lines,
                                    [](const SearchLine* line) { return line->name == "help"; }));
    EXPECT_FALSE(ranked(lines, "opacity").only_near);
    EXPECT_EQ(ranked(lines, "").lines.size(), lines.size());
    EXPECT_EQ(ranked(lines, " , ").lines.size(), lines.size());
}

} // namespace
} // namespace isochron::app
