// The lane of a film's keys: a click shows a key, a drag moves it once, Delete removes it, and the
// film plays.
#include "tests/app/panel/layer_fixture.h"

#include "interaction/navigation/key_frames.h"

#include <gmock/gmock.h>
#include <imgui_internal.h>

#include <cmath>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::KeyFrame;
using interaction::MouseButton;
using interaction::MouseButtonEvent;

class FilmLaneTest : public LayerTest {
  protected:
    FilmLaneTest() {
        for (const double isovalue : {1.0, 2.0, 3.0}) {
            KeyFrame key;
            key.time = 4 * (isovalue - 1);
            key.isovalue = isovalue;
            key.step = static_cast<std::uint32_t>(10 * isovalue);
            asked_.keys.push_back(key);
        }
        frame();
        frame();
    }
    /// Where a time of the film lies: 1.15 times its length are as wide as the track, which lies
    /// between the button and the words.
    glm::vec2 place(double time) {
        const PanelBox row = layer_.layout().film;
        const float y = (row.low.y + row.high.y) / 2;
        // From the outer marks, as people find them: by the words that they say.
        const auto found = [&](float from, float by) {
            for (float x = from; x > row.low.x && x < row.high.x; x += by) {
                point({x, y});
                frame();
                if (place_of_text(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts->Fonts.front(),
                                  "a click shows it, drag it to another time of the film, "
                                  "Delete removes it"))
                    return x + 2 * by;
            }
            ADD_FAILURE() << "no mark says what it is";
            return from;
        };
        if (first_ == last_) {
            first_ = found(row.low.x + 40, 4);
            last_ = found(row.high.x - 100, -4);
        }
        return {first_ + (last_ - first_) * static_cast<float>(time / 8), y};
    }
    float first_ = 0, last_ = 0; ///< places of the first and the last mark
};

TEST_F(FilmLaneTest, AClickShowsAKeyAndADragMovesItWhenTheHandLetsGo) {
    const glm::vec2 second = place(4), later = place(6);
    const Commands shown = click(second);
    EXPECT_FALSE(shown.keys);
    ASSERT_TRUE(shown.isosurfaces);
    EXPECT_EQ(shown.isosurfaces->front().isovalue, 2);
    EXPECT_EQ(shown.instant, index::Instant(20));
    point(second);
    frame({MouseButtonEvent{MouseButton::left, true}});
    for (int i = 1; i <= 4; ++i) {
        point(glm::mix(second, later, static_cast<float>(i) / 4));
        EXPECT_FALSE(frame().keys) << "one change to undo";
    }
    const Commands moved = frame({MouseButtonEvent{MouseButton::left, false}});
    ASSERT_TRUE(moved.keys);
    EXPECT_NEAR((*moved.keys)[1].time, 6, 0.1);
    EXPECT_EQ((*moved.keys)[2].time, 8);
    EXPECT_FALSE(moved.isosurfaces);
}

TEST_F(FilmLaneTest, DeleteRemovesTheChosenKeyAndNothingOfATool) {
    click(place(4));
    const std::vector<interaction::WindowEvent> event{
        interaction::KeyEvent{interaction::Key::del, true, 0}};
    const Commands removed = frame(event);
    EXPECT_TRUE(left_.empty()) << "no tool sees it";
    ASSERT_TRUE(removed.keys);
    EXPECT_EQ(removed.keys->size(), 2u);
    EXPECT_EQ(removed.keys->back().step, 30u);
    point({700, 300});
    frame();
    EXPECT_FALSE(frame(event).keys);
    EXPECT_FALSE(left_.empty()) << "elsewhere it is the tool's";
}

TEST_F(FilmLaneTest, ThePreviewGoesThroughTheFilmAndEnds) {
    const glm::vec2 low = layer_.layout().picture.low;
    click({low.x + 26, place(0).y});
    std::vector<double> seen;
    for (int i = 0; i < 100; ++i) {
        const Commands commands = frame();
        if (commands.isosurfaces) {
            asked_.isosurfaces = *commands.isosurfaces;
            seen.push_back(asked_.isovalue());
        }
        if (commands.instant)
            asked_.instant = *commands.instant;
    }
    ASSERT_GT(seen.size(), 40u);
    EXPECT_TRUE(std::ranges::is_sorted(seen)) << "from 1 to 3, never back";
    EXPECT_EQ(asked_.isovalue(), 3);
    EXPECT_EQ(asked_.instant, index::Instant(30));
    EXPECT_FALSE(layer_.outlook().busy) << "it has ended";
}

TEST_F(FilmLaneTest, IsNotThereWithoutKeys) {
    const auto says_film = [&] {
        frame();
        frame();
        return place_of_text(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts->Fonts.front(),
                             "film 8 s")
            .has_value();
    };
    EXPECT_TRUE(says_film());
    const auto words =
        place_of_text(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts->Fonts.front(), "film 8 s");
    const PanelBox row = layer_.layout().film;
    EXPECT_NEAR(words->y, (row.low.y + row.high.y) / 2, 2) << "on one line with the keys";
    asked_.keys.clear();
    EXPECT_FALSE(says_film());
}

TEST_F(FilmLaneTest, AKeyGetsANameAndATextInTheListAndTheTextIsWhatTheStoryTells) {
    const PanelBox row = layer_.layout().film;
    click({row.high.x - 44, (row.low.y + row.high.y) / 2}); // the list
    EXPECT_FALSE(click_word("name").keys);
    type("front, late"); // a comma is one
    Commands named = frame({interaction::KeyEvent{interaction::Key::enter, true, 0},
                            interaction::KeyEvent{interaction::Key::enter, false, 0}});
    merge(named, frame());
    ASSERT_TRUE(named.keys);
    EXPECT_EQ((*named.keys)[2].name, "front, late") << "of several fields it is the last one";
    asked_.keys = *named.keys;
    asked_.mark.point.emplace();
    asked_.mark.point->position = {1, 2, 3};
    click_word("2"); // chosen, and shown
    const auto below = [&](const char* words, float by) {
        for (int i = 0; i < 3; ++i)
            frame();
        const auto at =
            place_of_text(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts->Fonts.front(), words);
        EXPECT_TRUE(at) << words;
        return at ? glm::vec2(at->x, at->y + by) : glm::vec2(0.0f);
    };
    click(below("What the story says at key 2", 30));
    type("1.5 <b>m</b>, 100 %s http://a");
    const Commands written = click(below("What the story says at key 2", 2));
    ASSERT_TRUE(written.keys);
    EXPECT_EQ((*written.keys)[1].text, "1.5 <b>m</b>, 100 %s http://a");
    asked_.keys = *written.keys;
    const Commands placed = click_word("about the mark");
    ASSERT_TRUE(placed.keys);
    EXPECT_EQ((*placed.keys)[1].place, glm::dvec3(1, 2, 3));
    EXPECT_EQ(click_word("tell it").story, 2u);
}

/// The card of a story, which two of the keys tell.
class StoryCardTest : public FilmLaneTest {
  protected:
    StoryCardTest() {
        asked_.keys[0].text = "At first.";
        asked_.keys[2].text = "In the end.";
        asked_.keys[2].name = "the end";
        asked_.story = 1;
    }
    bool says(const std::string& words) {
        for (int i = 0; i < 3; ++i)
            frame();
        return place_of_text(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts->Fonts.front(), words)
            .has_value();
    }
};

TEST_F(StoryCardTest, GoesThroughTheStepsAndLeaves) {
    for (const bool panel : {true, false}) {
        asked_.panel = panel;
        asked_.story = 1;
        EXPECT_TRUE(says("1 of 2")) << panel;
        EXPECT_TRUE(says("At first."));
        EXPECT_FALSE(click_word("Previous").story) << "there is none";
        EXPECT_EQ(click_word("Next").story, 3u);
        asked_.story = 3;
        EXPECT_TRUE(says("2 of 2: the end"));
        EXPECT_FALSE(click_word("Next").story);
        EXPECT_EQ(click_word("Previous").story, 1u);
        EXPECT_EQ(click_word("Leave").story, 0u);
        asked_.story = 2; // a key without a text
        EXPECT_FALSE(says("Leave"));
    }
}

TEST_F(StoryCardTest, StaysInThePictureHoweverLongItsTextIsAndShowsItAsItIs) {
    const std::string kinds[]{std::string(interaction::kLongestStoryText, 'w'),
                              [] {
                                  std::string words;
                                  while (words.size() + 5 < interaction::kLongestStoryText)
                                      words += "long ";
                                  return words;
                              }(),
                              std::string(interaction::kLongestStoryText, '\n'),
                              "%s%n%d <b>bold</b>\n##id ###id \x1b[31m \xe2\x80\xae"};
    for (const glm::ivec2 size : {glm::ivec2(640, 480), glm::ivec2(320, 240), kSize})
        for (const bool panel : {true, false})
            for (const std::string& text : kinds) {
                size_ = size;
                asked_.panel = panel;
                asked_.keys[0].text = text;
                for (int i = 0; i < 4; ++i)
                    frame();
                const ImGuiWindow* const card = ImGui::FindWindowByName("###story");
                ASSERT_TRUE(card && card->Active);
                EXPECT_GE(card->Pos.x, 0) << size.x;
                EXPECT_GE(card->Pos.y, 0) << size.x << panel << text.substr(0, 9);
                EXPECT_LE(card->Pos.x + card->Size.x, static_cast<float>(size.x));
                EXPECT_LE(card->Pos.y + card->Size.y, static_cast<float>(size.y));
                EXPECT_EQ(click_word("Next").story, 3u);
            }
    EXPECT_TRUE(says("%s%n%d <b>bold</b>"));
}

} // namespace
} // namespace isochron::app
