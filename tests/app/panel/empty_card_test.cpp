// The card over an empty picture: its button, its key, and what stands in its way.
#include "app/panel/search_rank.h"
#include "tests/app/panel/drawn_text.h"
#include "tests/app/panel/layer_fixture.h"
#include "tests/app/panel/searched_session.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <cstddef>
#include <ranges>
#include <string>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::Key;
using interaction::KeyEvent;

constexpr const char* kSentence = "No surface at 500: values are 0 to 100.";

EmptyPicture far_away(double isovalue) {
    EmptyPicture empty{
        .why = EmptyBecause::outside, .sentence = kSentence, .way = "Go to 95", .commands = {}};
    empty.commands.isovalue = isovalue;
    return empty;
}

class EmptyCard : public LayerTest {
  protected:
    bool shows(const std::string& words) {
        for (int i = 0; i < 3; ++i) // Dear ImGui shows a new window late
            frame();
        return place_of_text(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts->Fonts.front(), words)
            .has_value();
    }
    /// @return the commands that the key led to
    Commands strike(Key key) {
        Commands all = frame({KeyEvent{key, true}, KeyEvent{key, false}});
        merge(all, frame());
        return all;
    }
};

TEST_F(EmptyCard, StandsInTheMiddleOfThePictureAsLongAsItIsEmpty) {
    EXPECT_FALSE(shows(kSentence));
    notes_.empty = far_away(95);
    ASSERT_TRUE(shows(kSentence));
    EXPECT_TRUE(shows("no surface")) << "in the place of how exact the picture is";
    const auto at =
        place_of_text(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts->Fonts.front(), kSentence);
    const PanelBox& picture = layer_.layout().picture;
    EXPECT_TRUE(picture.contains({at->x, at->y}));
    EXPECT_TRUE(layer_.covers(glm::vec2(at->x, at->y) / glm::vec2(kSize)))
        << "a click on it does not reach the data";
    notes_.empty.reset();
    EXPECT_FALSE(shows(kSentence));
}

TEST_F(EmptyCard, AClickAndEnterTakeTheWayOut) {
    notes_.empty = far_away(95);
    frame();
    EXPECT_EQ(click_word("Go to 95 (Enter)").isovalue, 95.0);
    EXPECT_EQ(strike(Key::enter).isovalue, 95.0);
    asked_.panel = false;
    ASSERT_TRUE(shows(kSentence)) << "without the panel, too";
    EXPECT_EQ(strike(Key::enter).isovalue, 95.0);
}

TEST_F(EmptyCard, EnterIsForOthersWhereThereIsNoWayOutOrSomethingElseIsOpen) {
    EXPECT_FALSE(strike(Key::enter).isovalue);
    notes_.empty = far_away(95);
    notes_.empty->way.clear();
    frame();
    EXPECT_FALSE(strike(Key::enter).isovalue) << "no way out";
    notes_.empty = far_away(95);
    asked_.leaving = true;
    frame();
    EXPECT_FALSE(strike(Key::enter).isovalue) << "it answers whether to quit";
    asked_.leaving = false;
    frame();
    strike(Key::f1);
    frame();
    EXPECT_FALSE(strike(Key::enter).isovalue) << "the help lies over the picture";
}

TEST_F(EmptyCard, IsALineOfTheSearch) {
    Searched session;
    PanelModel model = session.model();
    model.notes.empty = far_away(95);
    const auto lines = search_lines(model);
    for (const char* typed : {"no surface", "nothing shown", "where is my data"}) {
        const Ranking found = ranked(lines, typed);
        ASSERT_FALSE(found.lines.empty());
        EXPECT_TRUE(std::ranges::any_of(found.lines | std::views::take(3), [](const auto* line) {
            return line->name == "way_out" && line->commands.isovalue == 95.0;
        })) << typed;
    }
    model.notes.empty.reset();
    EXPECT_TRUE(std::ranges::none_of(
        search_lines(model), [](const SearchLine& line) { return line.name == "way_out"; }));
}

TEST_F(EmptyCard, AFurtherSurfaceIsChosenByTheStep) {
    Searched session;
    PanelModel model = session.model();
    StepSurvey step;
    step.whole = true;
    step.low = 0;
    step.high = 100;
    step.histogram.assign(StepSurvey::kBins, 1);
    step.cells.assign(StepSurvey::kBins, 1000);
    for (std::size_t bin = step.bin_of(80); bin < StepSurvey::kBins; ++bin)
        step.cells[bin] = 300; // where the first one has 1000
    model.work.survey = &step;
    for (const SearchLine& line : search_lines(model))
        if (line.name == "add_surface" && line.commands.isosurfaces) {
            EXPECT_GT(line.commands.isosurfaces->back().isovalue, 80);
            return;
        }
    FAIL() << "no line adds a surface";
}

} // namespace
} // namespace isochron::app
