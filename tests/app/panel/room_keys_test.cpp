// A hand that has no keyboard types numbers and names on the panel in the room, and drags the time.
#include "tests/app/panel/drawn_text.h"
#include "tests/app/panel/layer_fixture.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {
namespace {

using interaction::Commands;

class RoomKeysTest : public LayerTest {
  protected:
    static constexpr glm::ivec2 kRoom{400, 540};

    RoomKeysTest() { info_.grid.vertices = {2, 2, 2}; }

    Commands ray(std::optional<glm::vec2> at, bool pressed) {
        layer_.point(at, pressed, 0);
        time_ += interaction::Seconds(0.1);
        return layer_.lay_out(kRoom,
                              {.place = PanelPlace::in_room,
                               .info = info_,
                               .stats = stats_,
                               .asked = asked_,
                               .frame = report_,
                               .arrays = arrays_,
                               .controls = controls_},
                              time_);
    }
    Commands press_at(glm::vec2 at) {
        ray(at, false);
        Commands all = ray(at, true);
        merge(all, ray(at, false));
        merge(all, ray(at, false));
        return all;
    }
    /// Presses a word of the panel, wherever it stands.
    Commands press_word(const std::string& word) {
        ray(std::nullopt, false);
        const ImFont& font = *ImGui::GetIO().Fonts->Fonts.front();
        const auto at = place_of_text(*ImGui::GetDrawData(), font, word);
        EXPECT_TRUE(at) << word;
        return at ? press_at({at->x, at->y}) : Commands();
    }
};

TEST_F(RoomKeysTest, ANumberIsTypedByARayAlone) {
    asked_.set_isovalue(37.25);
    ray(std::nullopt, false);
    press_word("37.25");
    for (const char* const key : {"1", "2", ".", "5"})
        press_word(key);
    const Commands commands = press_word("accept");
    EXPECT_EQ(commands.isovalue, 12.5);
}

TEST_F(RoomKeysTest, EveryWordOfSlicesAndOfTheClipBoxStandsOnThePanel) {
    asked_.slices.planes = {{{1, 0, 0}, {1, 0, 0}}, {{0, 1, 0}, {0, 1, 0}}};
    asked_.clip = {true, {0, 0, 1}, {0, 0, 1}};
    asked_.clip_box = {true, {0, 0, 0}, {1, 1, 1}};
    for (int i = 0; i < 3; ++i)
        ray(std::nullopt, false);
    const ImFont& font = *ImGui::GetIO().Fonts->Fonts.front();
    for (const char* const word :
         {"isolines", "alone", "flat", "slice across", "clip across", "normal", "box", "z"}) {
        const auto middle = place_of_text(*ImGui::GetDrawData(), font, word);
        ASSERT_TRUE(middle) << word;
        EXPECT_LT(middle->x + ImGui::CalcTextSize(word).x / 2, kRoom.x - 6) << word;
    }
    EXPECT_EQ(read_text(*ImGui::GetDrawData(), font).faults.size(), 0u);
    asked_.clip = {};
    asked_.clip_box = {};
    ray(std::nullopt, false);
    EXPECT_TRUE(press_word("flat").slices.has_value());
}

TEST_F(RoomKeysTest, WhatIsCanceledChangesNothing) {
    asked_.set_isovalue(37.25);
    press_word("37.25");
    press_word("7");
    EXPECT_EQ(press_word("cancel"), Commands());
    EXPECT_FALSE(ray(std::nullopt, false).isovalue);
}

TEST_F(RoomKeysTest, ARayDragsTimeBetweenTheSteps) {
    info_.times = {0, 1, 2, 3};
    const auto moments = [&] {
        std::vector<index::Instant> seen;
        for (float y = kRoom.y - 60.0f; y < kRoom.y && seen.empty(); y += 4) {
            ray({{60.0f, y}}, false);
            for (float x = 60; x <= 330; x += 5) {
                const Commands commands = ray({{x, y}}, true);
                if (commands.isosurfaces || commands.playback)
                    break; // something else lies there
                if (commands.instant)
                    seen.push_back(*commands.instant);
                asked_.instant = commands.instant.value_or(asked_.instant);
            }
            ray({{60.0f, y}}, false);
        }
        return seen;
    };
    const auto between = [](index::Instant at) { return at.between(); };
    asked_.between = interaction::BetweenSteps::blend;
    const auto blended = moments();
    EXPECT_GT(std::ranges::count_if(blended, between), 20);
    EXPECT_TRUE(std::ranges::any_of(blended, [&](const auto& at) { return !between(at); }))
        << "near a step it is the step itself";
    EXPECT_TRUE(std::ranges::is_sorted(blended));
    asked_.between = interaction::BetweenSteps::hold;
    asked_.instant = {};
    const auto held = moments();
    EXPECT_GE(held.size(), 2u);
    EXPECT_TRUE(std::ranges::none_of(held, between));
}

TEST_F(RoomKeysTest, SurfacesAreExportedByARayAlone) {
    ray(std::nullopt, false);
    const float line = (layer_.layout().top.low.y + layer_.layout().top.high.y) / 2;
    const auto is_shown = [](const char* word) {
        return place_of_text(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts->Fonts.front(), word)
            .has_value();
    };
    for (float x = 4; x < 400 && !is_shown("Export"); x += 9) {
        press_at({1.0f, kRoom.y - 1.0f}); // closes what the press before opened over this row
        press_at({x, line});
        ray(std::nullopt, false);
    }
    ASSERT_TRUE(is_shown("Export"));
    press_word("ply");
    const Commands commands = press_word("stl");
    ASSERT_TRUE(commands.pictures);
    EXPECT_EQ(commands.pictures->surfaces.format, "stl");
    EXPECT_EQ(press_word("Export").exporting, (interaction::ExportWork{true, 0}));
}

TEST_F(RoomKeysTest, ACommandIsFoundAndRunByARayAlone) {
    ray(std::nullopt, false);
    const PanelBox top = layer_.layout().top;
    press_at({top.high.x - 24, (top.low.y + top.high.y) / 2});
    press_word("what do you want to do?");
    for (const char* const key : {"p", "a", "r", "a", "l", "l", "e", "l"})
        press_word(key);
    press_word("accept");
    EXPECT_FALSE(layer_.pages().take_action()) << "found is not yet chosen";
    press_word("parallel (orthographic) projection on, off");
    EXPECT_EQ(layer_.pages().take_action(), interaction::Action::orthographic);
    EXPECT_FALSE(layer_.pages().take_action()) << "once";
    EXPECT_FALSE(layer_.pages().any());
}

TEST_F(RoomKeysTest, ASettingIsFoundByARayAlone) {
    ray(std::nullopt, false);
    const PanelBox top = layer_.layout().top;
    press_at({top.high.x - 24, (top.low.y + top.high.y) / 2});
    press_word("what do you want to do?");
    for (const char* const key : {"g", "l", "o", "s", "s"})
        press_word(key);
    press_word("accept");
    EXPECT_EQ(press_word("material: glossy").look,
              (interaction::Look{.material = interaction::Material::glossy}));
    EXPECT_FALSE(layer_.pages().any());
}

TEST_F(RoomKeysTest, AnArrayIsChosenOfAllByARayAlone) {
    offer_three_arrays();
    press_word("Data");
    press_word("heat");
    press_word("all arrays ...");
    EXPECT_TRUE(layer_.pages().any());
    EXPECT_EQ(press_word("0 to 5").array, "speed");
    EXPECT_FALSE(layer_.pages().any());
    ray(std::nullopt, false);
    const PanelBox top = layer_.layout().top;
    press_at({top.high.x - 24, (top.low.y + top.high.y) / 2});
    press_word("arrays: choose by name, values, unit and grid");
    EXPECT_TRUE(layer_.pages().any()) << "the search leads there, too";
    EXPECT_FALSE(layer_.pages().take_action());
    press_word("Close");
    EXPECT_FALSE(layer_.pages().any());
}

TEST_F(RoomKeysTest, AViewpointGetsItsNameByARayAlone) {
    asked_.views = {{"view-1", {}}};
    press_word("View");
    press_word("1 saved");
    press_word("view-1");
    for (const char* const key : {"capitals", "T", "capitals", "o", "p"})
        press_word(key);
    const Commands commands = press_word("accept");
    ASSERT_TRUE(commands.views);
    EXPECT_EQ(commands.views->front().name, "Top");
}

} // namespace
} // namespace isochron::app
