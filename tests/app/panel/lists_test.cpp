// Lists that lie over the picture: their keys, and the arrays that they offer.
#include "tests/app/panel/drawn_text.h"
#include "tests/app/panel/layer_fixture.h"

#include <gmock/gmock.h>
#include <imgui.h>

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::Key;
using interaction::KeyEvent;
using interaction::Modifier;

constexpr auto kControl = static_cast<std::uint8_t>(Modifier::control);

class Lists : public LayerTest {
  protected:
    Lists() {
        offer_three_arrays();
        frame();
    }
    /// Presses a key and lets it go. @return the commands that it led to
    Commands strike(Key key, std::uint8_t modifiers = 0) {
        Commands all = frame({KeyEvent{key, true, modifiers}, KeyEvent{key, false, modifiers}});
        reached_picture_ = has_press(key);
        for (int i = 0; i < 2; ++i) {
            merge(all, frame());
            reached_picture_ = reached_picture_ || has_press(key);
        }
        return all;
    }
    void open_arrays() {
        frame({KeyEvent{Key::left_shift, true}, KeyEvent{Key{'A'}, true, kControl},
               KeyEvent{Key{'A'}, false, kControl}, KeyEvent{Key::left_shift, false}});
        frame();
    }
    bool has_press(Key key) const {
        return std::ranges::any_of(left_, [key](const interaction::WindowEvent& event) {
            const auto* change = std::get_if<KeyEvent>(&event);
            return change && change->key == key && change->down;
        });
    }

    bool reached_picture_ = false; ///< the last key did something beside the panel
};

TEST_F(Lists, HaveTheArrowKeysForThemselvesAsLongAsTheyAreOpen) {
    using enum Key;
    const auto expect_all = [&](bool reach_picture, const char* where) {
        for (const Key key : {Key::up, Key::down, Key::left, Key::right}) {
            strike(key);
            EXPECT_EQ(reached_picture_, reach_picture) << where << " " << static_cast<int>(key);
        }
    };
    expect_all(true, "the picture");
    click_word("heat");
    expect_all(false, "a list in the column");
    strike(Key::escape);
    expect_all(true, "the picture again");
    strike(Key{'K'}, kControl);
    expect_all(false, "the search");
    strike(Key::escape);
    layer_.pages().offer_files([] { return std::vector<std::filesystem::path>(); });
    strike(Key{'O'}, kControl);
    expect_all(false, "the choice of data");
    strike(Key::escape);
    open_arrays();
    expect_all(false, "the arrays");
    strike(Key::escape);
    expect_all(true, "the picture at the end");
}

TEST_F(Lists, AreGoneThroughByKeysAlone) {
    click_word("heat");
    EXPECT_FALSE(strike(Key::down).array);
    EXPECT_FALSE(strike(Key::down).array) << "not yet chosen";
    strike(Key::up);
    EXPECT_EQ(strike(Key::enter).array, "rho");
    EXPECT_FALSE(reached_picture_) << "where Enter picks a place";
    strike(Key::down);
    EXPECT_TRUE(reached_picture_) << "the list is closed";
}

TEST_F(Lists, OfArraysComesFromTheDataFromItsKeyAndFromTheSearch) {
    click_word("heat");
    click_word("all arrays ...");
    EXPECT_TRUE(layer_.pages().any());
    for (const char* const words : {"0 to 4", "kg", "6 x 6 x 6, 1 step"})
        EXPECT_TRUE(
            place_of_text(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts->Fonts.front(), words))
            << words;
    strike(Key::escape);
    EXPECT_FALSE(layer_.pages().any());
    open_arrays();
    EXPECT_TRUE(layer_.pages().any());
    open_arrays();
    EXPECT_FALSE(layer_.pages().any()) << "the same key closes it";
    strike(Key{'K'}, kControl);
    type("arrays");
    strike(Key::enter);
    for (int i = 0; i < 4; ++i)
        frame();
    strike(Key::down);
    EXPECT_EQ(strike(Key::enter).array, "rho");
    EXPECT_FALSE(layer_.pages().any());
}

TEST_F(Lists, OfArraysShowWholeWordsWhereTheTableHasRoomForThem) {
    const std::vector<ListedArray> lines{
        {"temperature", "40 x 40 x 40, 5 steps", "degrees_Celsius",
         "271.023 to 304.186, 32.6 % missing", ""},
        {"rho", "40 x 40 x 40, 5 steps", "", "101318.01 to 101332", ""}};
    arrays_.lines = lines;
    for (const glm::ivec2 size : {glm::ivec2(1280, 800), glm::ivec2(680, 480)}) {
        size_ = size;
        frame();
        open_arrays();
        frame();
        for (const std::string& word :
             {lines[0].name, lines[0].values, lines[0].unit, lines[0].grid, lines[1].values})
            EXPECT_TRUE(
                place_of_text(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts->Fonts.front(), word))
                << word << " at " << size.x;
        strike(Key::escape);
    }
}

TEST_F(Lists, OfArraysLeadToTheOneThatIsChosen) {
    open_arrays();
    strike(Key::down);
    strike(Key::down);
    EXPECT_EQ(strike(Key::enter).array, "speed");
    EXPECT_FALSE(layer_.pages().any());
    EXPECT_FALSE(layer_.pages().take_chosen_array());
    open_arrays();
    EXPECT_EQ(strike(Key::enter), Commands()) << "it is shown already";
}

TEST_F(Lists, OfArraysHasThoseOfOtherShapesToo) {
    arrays_ = {};
    layer_.pages().offer_arrays({{"worse", "", "", "", "complex values"},
                                 {"fine", "64 x 64 x 64, 1 step", "m", "0 to 1", ""}});
    info_.array = "heat";
    click_word("Objects"); // folds the list, which has the same word
    click_word("heat");
    click_word("all arrays ...");
    strike(Key::down);
    EXPECT_EQ(strike(Key::enter), Commands());
    EXPECT_TRUE(layer_.pages().any()) << "one cannot be shown";
    strike(Key::down);
    EXPECT_EQ(strike(Key::enter), Commands()) << "no command: other data are opened";
    EXPECT_EQ(layer_.pages().take_chosen_array(), "fine");
    EXPECT_FALSE(layer_.pages().take_chosen_array()) << "once";
}

TEST_F(Lists, OfTheSearchHaveTheSettingsThatAreFoundByTheirWords) {
    const auto chosen = [&](std::string_view words) {
        strike(Key{'K'}, kControl);
        type(words);
        return strike(Key::enter);
    };
    EXPECT_EQ(chosen("light background").look,
              (interaction::Look{.background = interaction::Background::light}));
    EXPECT_EQ(chosen("GLOSSY").look,
              (interaction::Look{.material = interaction::Material::glossy}));
    EXPECT_EQ(chosen("color by: first").coloring,
              (interaction::Coloring{.by = interaction::ColorBy::first_crossing}));
    EXPECT_EQ(chosen("inferno").coloring, (interaction::Coloring{.map = "inferno"}));
    EXPECT_EQ(chosen("top_bottom").stereo, "top_bottom");
    EXPECT_EQ(chosen("array: speed").array, "speed");
    EXPECT_FALSE(layer_.pages().any()) << "it closes with a choice";
    EXPECT_EQ(chosen("no such thing"), Commands());
    EXPECT_TRUE(layer_.pages().any());
}

} // namespace
} // namespace isochron::app
