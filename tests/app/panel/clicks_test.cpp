// What is done most often takes one click on the panel, and no search for it.
#include "tests/app/panel/drawn_text.h"
#include "tests/app/panel/layer_fixture.h"

#include "app/panel/parts/key_search.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <utility>
#include <variant>
#include <vector>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::Key;
using interaction::KeyEvent;
using interaction::MouseButton;
using interaction::MouseButtonEvent;

class Clicks : public LayerTest {
  protected:
    /// Clicks along a line of the panel until a click does what is looked for.
    bool one_click(glm::vec2 from, glm::vec2 to, const std::function<bool(const Commands&)>& is) {
        const float length = glm::length(to - from);
        for (float at = 0; at < length; at += 9) {
            frame();
            const bool found = is(click(from + (to - from) * (at / length)));
            press(Key::escape); // what it has opened instead
            if (found)
                return true;
        }
        return false;
    }
    static bool clips_along_x(const Commands& commands) {
        return commands.clip && commands.clip->shown && std::abs(commands.clip->normal.x) > 0.9;
    }
};

TEST_F(Clicks, OfAWindowWithoutRoomForThePanelEndInNoCrash) {
    for (const glm::ivec2 size : {glm::ivec2(128, 96), glm::ivec2(16, 16), glm::ivec2(600, 40)}) {
        size_ = size;
        frame();
        click(glm::vec2(size) / 2.0f);
    }
}

TEST_F(Clicks, OneLeadsToTheNextStepASecondSurfaceAndAPicture) {
    frame();
    const PanelLayout layout = layer_.layout();
    const float middle = (layout.time.low.y + layout.time.high.y) / 2;
    EXPECT_TRUE(one_click({0, middle}, {300, middle}, [](const Commands& commands) {
        return commands.instant == index::Instant(1);
    }));
    EXPECT_TRUE(one_click({23, 481}, {23, 441}, [](const Commands& commands) {
        return commands.isosurfaces && commands.isosurfaces->size() == 2;
    }));
    EXPECT_TRUE(one_click({0, 18}, {400, 18},
                          [](const Commands& commands) { return commands.screenshot; }));
}

TEST_F(Clicks, TwoLeadToAClipPlaneAcrossX) {
    EXPECT_TRUE(one_click({0, 18}, {400, 18}, [](const Commands& commands) {
        return commands.tools && commands.tools->mouse == interaction::ToolKind::clip;
    }));
    asked_.tools.mouse = interaction::ToolKind::clip;
    frame();
    const glm::vec2 corner = layer_.layout().picture.low;
    EXPECT_TRUE(one_click(corner + glm::vec2(60, 24), corner + glm::vec2(400, 24), clips_along_x));
}

TEST_F(Clicks, ALineOfTheHistogramIsTakenWhereTheHandIsAndPicksItsSurface) {
    asked_.isosurfaces = {{20, {1, 0, 0}, 1}, {80, {0, 1, 0}, 1}};
    size_.y = 1000; // all of the panel has room, and no scroll bar stands beside it
    frame();
    // From 12 to 288 lie the values 0 to 100.
    const auto place_of = [](float value) { return glm::vec2(12 + 2.76f * value, 367); };
    const Commands near_second = click(place_of(81));
    EXPECT_EQ(near_second.picked, 1u);
    EXPECT_NEAR(near_second.isovalue.value_or(0), 81, 0.5);
    const Commands nearer_first = click(place_of(21));
    EXPECT_FALSE(nearer_first.picked) << "it is picked";
    EXPECT_NEAR(nearer_first.isovalue.value_or(0), 21, 0.5);
    EXPECT_NEAR(click(place_of(50)).isovalue.value_or(0), 50, 0.5) << "the picked one comes there";
}

TEST_F(Clicks, TheEndsOfTheRangeAreDraggedAboveTheTrack) {
    frame();
    const PanelLayout layout = layer_.layout();
    const float lane = layout.time.low.y + 8;
    point({1266, lane});
    frame({MouseButtonEvent{MouseButton::left, true}});
    point({1000, lane});
    Commands commands = frame();
    ASSERT_TRUE(commands.play_range);
    EXPECT_FALSE(commands.play_range->first);
    ASSERT_TRUE(commands.play_range->last);
    EXPECT_GT(*commands.play_range->last, 500u);
    EXPECT_LT(*commands.play_range->last, 1990u);
    EXPECT_FALSE(commands.instant) << "the step stays";
    asked_.play_range = *commands.play_range;
    point({1275, lane});
    commands = frame();
    EXPECT_EQ(commands.play_range, interaction::StepRange{}) << "its end is that of the series";
    frame({MouseButtonEvent{MouseButton::left, false}});
}

TEST_F(Clicks, AFlagLeadsToItsBookmark) {
    asked_.bookmarks = {{"early", index::Instant(3)}, {"late", index::Instant(1999)}};
    asked_.playback.playing = true;
    frame();
    const Commands commands = click({1267, layer_.layout().time.low.y + 8});
    EXPECT_EQ(commands.instant, index::Instant(1999));
    ASSERT_TRUE(commands.playback);
    EXPECT_FALSE(commands.playback->playing);
    EXPECT_FALSE(commands.play_range) << "although the range ends there";
}

TEST_F(Clicks, AFlagBetweenTwoStepsLeadsBetweenThem) {
    asked_.between = interaction::BetweenSteps::blend;
    asked_.bookmarks = {{"between", {1998, index::Instant::kFractions / 2}}};
    frame();
    const Commands commands = click({1267, layer_.layout().time.low.y + 8});
    EXPECT_EQ(commands.instant, asked_.bookmarks.front().instant);
}

TEST_F(Clicks, BackFromBetweenTwoStepsLeadsToTheEarlierOne) {
    asked_.between = interaction::BetweenSteps::blend;
    asked_.instant = {7, index::Instant::kFractions / 2};
    frame();
    const PanelLayout layout = layer_.layout();
    const float middle = (layout.time.low.y + layout.time.high.y) / 2;
    EXPECT_TRUE(one_click({0, middle}, {300, middle}, [](const Commands& commands) {
        return commands.instant == index::Instant(7);
    }));
}

TEST_F(Clicks, SurfacesAreExportedInAFormatThatIsChosen) {
    asked_.play_range = {3, 9};
    frame();
    const auto open = [&] {
        for (float x = 12; x < 500; x += 20) { // a tool is wider
            click({x, 18});
            for (int i = 0; i < 2; ++i)
                frame();
            const bool shown =
                place_of_text(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts->Fonts.front(),
                              asked_.exporting.goes_on ? "Cancel" : "Export")
                    .has_value();
            if (shown)
                return true;
            press(Key::escape);
        }
        return false;
    };
    ASSERT_TRUE(open());
    click_word("ply");
    Commands commands = click_word("vtp");
    ASSERT_TRUE(commands.pictures);
    EXPECT_EQ(commands.pictures->surfaces.format, "vtp");
    asked_.pictures = *commands.pictures;
    click_word("this time");
    commands = click_word("steps 4 to 10");
    ASSERT_TRUE(commands.pictures);
    EXPECT_EQ(commands.pictures->surfaces.steps, interaction::ExportedSteps::range);
    EXPECT_EQ(commands.pictures->surfaces.format, "vtp");
    asked_.pictures = *commands.pictures;
    EXPECT_EQ(click_word("Export").exporting, (interaction::ExportWork{true, 0}));
    asked_.exporting = {true, 40};
    ASSERT_TRUE(open());
    EXPECT_EQ(click_word("Cancel").exporting, interaction::ExportWork{});
}

TEST_F(Clicks, APlaceThatIsTypedMovesTheClipPlaneAlongItsNormal) {
    asked_.clip = {true, {0.5, 0.5, 0.5}, {-1, 0, 0}};
    frame();
    for (int i = 0; i < 3; ++i) // the strip takes some to know its size
        frame();
    const auto field =
        place_of_text(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts->Fonts.front(), "0.5");
    ASSERT_TRUE(field);
    click({field->x, field->y});
    type("0.25");
    Commands commands;
    merge(commands, frame({KeyEvent{Key::enter, true}, KeyEvent{Key::enter, false}}));
    merge(commands, frame());
    ASSERT_TRUE(commands.clip);
    EXPECT_NEAR(commands.clip->point.x, 0.25, 1e-6);
    EXPECT_EQ(commands.clip->normal, asked_.clip.normal);
}

TEST_F(Clicks, TheCubeTurnsTheDataToTheFaceThatIsClicked) {
    asked_.room_from_physical.translation = {0, 0, -3};
    info_.grid.vertices = {2, 2, 2};
    frame();
    const PanelBox picture = layer_.layout().picture;
    const Commands commands = click({picture.high.x - 54, picture.low.y + 52});
    ASSERT_TRUE(commands.room_from_physical);
    const glm::dvec3 up = commands.room_from_physical->rotation * glm::dvec3(0, 0, 1);
    EXPECT_NEAR(up.z, 1, 1e-6) << "+z looks at the viewer";
}

TEST_F(Clicks, APressThatComesWithAJumpIntoThePictureBelongsToThePicture) {
    const auto press_after_jump = [&](glm::vec2 from, glm::vec2 to) {
        for (int i = 0; i < 4; ++i)
            point(from);
        frame({interaction::MouseMoveEvent{to.x / float(kSize.x), to.y / float(kSize.y), kSize.x,
                                           kSize.y},
               MouseButtonEvent{MouseButton::left, true}});
        const bool left = std::ranges::any_of(left_, [](const interaction::WindowEvent& event) {
            const auto* button = std::get_if<MouseButtonEvent>(&event);
            return button && button->down;
        });
        EXPECT_EQ(layer_.covers(to / glm::vec2(kSize)), !left) << "the ray through the cursor, too";
        frame({MouseButtonEvent{MouseButton::left, false}});
        return left;
    };
    layer_.pages().introduce();
    for (int i = 0; i < 4; ++i)
        frame();
    const auto hint =
        place_of_text(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts->Fonts.front(), "No, thanks");
    ASSERT_TRUE(hint);
    const glm::vec2 picture{700, 380}, column{150, 300}, on_hint{hint->x - 60, hint->y};
    EXPECT_TRUE(press_after_jump(on_hint, picture));
    EXPECT_TRUE(press_after_jump(column, picture));
    EXPECT_FALSE(press_after_jump(picture, column));
    EXPECT_FALSE(press_after_jump(picture, on_hint));
    EXPECT_TRUE(press_after_jump(on_hint, picture)) << "also after one on the panel";
    EXPECT_TRUE(press_after_jump(picture, picture));
}

TEST_F(Clicks, ACommandIsFoundByItsWordsAndRunByItsKey) {
    constexpr auto kControl = static_cast<std::uint8_t>(interaction::Modifier::control);
    frame();
    press(Key{'K'}, kControl);
    type("parallel");
    std::vector<interaction::WindowEvent> pressed;
    frame({KeyEvent{Key::enter, true}, KeyEvent{Key::enter, false}});
    for (int i = 0; i < 4; ++i) {
        frame();
        pressed.insert(pressed.end(), left_.begin(), left_.end());
    }
    std::vector<std::pair<Key, bool>> keys;
    for (const auto& event : pressed)
        if (const auto* key = std::get_if<KeyEvent>(&event); key && key->key == Key{'0'})
            keys.emplace_back(key->key, key->down);
    EXPECT_EQ(keys, (std::vector<std::pair<Key, bool>>{{Key{'0'}, true}, {Key{'0'}, false}}));
    EXPECT_FALSE(layer_.pages().any()) << "the search closes";
}

/// The list of the data that were open lately, of one line, with the mouse at that line.
class ClicksOnALine : public LayerTest {
  protected:
    ClicksOnALine() {
        layer_.pages().offer_files([this] { return std::vector<std::filesystem::path>{lately_}; });
        open();
    }
    void open() {
        layer_.pages().open_files();
        for (int i = 0; i < 5; ++i)
            show(0.5, {});
        const auto place =
            place_of_text(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts->Fonts.front(),
                          std::filesystem::path(lately_).filename().string());
        ASSERT_TRUE(place);
        show(0.1, {interaction::MouseMoveEvent{place->x / float(kSize.x), place->y / float(kSize.y),
                                               kSize.x, kSize.y}});
    }
    /// A frame so many seconds after the last. @return whether data have been chosen in it
    bool show(double after, const std::vector<interaction::WindowEvent>& events) {
        time_ += interaction::Seconds(after);
        layer_.feed(events, true);
        layer_.lay_out_files(kSize, {}, time_);
        return layer_.pages().take_chosen().has_value();
    }
    /// @return whether it has chosen data
    bool click(double after) {
        const bool pressed = show(after, {MouseButtonEvent{MouseButton::left, true}});
        return show(0.01, {MouseButtonEvent{MouseButton::left, false}}) || pressed;
    }

    const std::string lately_ = "/lately.vti"; ///< nothing of it is read
};

TEST_F(ClicksOnALine, OpenNothingWithAPauseBetweenThem) {
    EXPECT_FALSE(click(1));
    EXPECT_FALSE(click(10)); // the window had no frame in between
    EXPECT_FALSE(click(10));
    EXPECT_TRUE(click(0.35));
}

TEST_F(ClicksOnALine, OpenItInWhateverFramesTheyFall) {
    // The filter takes the keyboard two frames after a click on a line, maybe with the second one.
    for (int between = 0; between < 8; ++between) {
        EXPECT_FALSE(click(1));
        for (int i = 0; i < between; ++i)
            EXPECT_FALSE(show(0.01, {}));
        EXPECT_TRUE(click(0.01)) << between << " frames from release to press";
        open();
    }
}

} // namespace
} // namespace isochron::app
