// Where the panel's parts lie, and which keys its search presses.
#include "app/panel/parts/panel_layout.h"
#include "app/panel/search_table.h"
#include "interaction/controls/desktop_emulation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>

namespace isochron::app {
namespace {

using interaction::Action;

double share_of_picture(glm::vec2 size) {
    const glm::vec2 picture = layout_in(PanelPlace::over, size).picture.size();
    return double(picture.x) * double(picture.y) / (double(size.x) * double(size.y));
}

TEST(PanelLayout, LeavesMostOfTheWindowToThePicture) {
    EXPECT_GE(share_of_picture({1280, 800}), 0.68);
    EXPECT_GE(share_of_picture({640, 480}), 0.60);
    EXPECT_FALSE(layout_in(PanelPlace::over, {1280, 800}).folded);
    EXPECT_TRUE(layout_in(PanelPlace::over, {640, 480}).folded);
}

TEST(PanelLayout, FillsThePanelWithoutGapsOrOverlaps) {
    for (int way = 0; way < 12; ++way)
        for (const glm::vec2 size : {glm::vec2(300, 240), glm::vec2(400, 540), glm::vec2(640, 480),
                                     glm::vec2(1280, 720), glm::vec2(1280, 800)}) {
            SCOPED_TRACE(testing::Message() << way << ' ' << size.x << ' ' << size.y);
            const auto place = static_cast<PanelPlace>(way / 4);
            const PanelRows rows{.film = way % 2 == 1, .curves = way / 2 % 2 == 1};
            const PanelLayout layout = layout_in(place, size, rows);
            const bool over = place == PanelPlace::over;
            EXPECT_EQ(layout.top.high.y, layout.column.low.y);
            EXPECT_EQ(layout.column.high.y, over ? layout.time.low.y : layout.curves.low.y);
            EXPECT_EQ(layout.film.high, glm::vec2(size.x, layout.time.low.y));
            EXPECT_EQ(layout.curves.high, glm::vec2(size.x, layout.film.low.y));
            EXPECT_EQ(layout.film.low.x, layout.curves.low.x);
            EXPECT_EQ(layout.film.size().y > 0, rows.film);
            EXPECT_EQ(layout.curves.low.x, over ? layout.column.high.x : 0);
            EXPECT_EQ(layout.curves.size().y > 0, rows.curves);
            EXPECT_LE(layout.curves.size().y, (layout.time.low.y - layout.top.high.y) / 2);
            EXPECT_EQ(layout.time.high, size);
            EXPECT_EQ(layout.column.high.x, layout.picture.low.x);
            EXPECT_EQ(layout.picture.high,
                      glm::vec2(size.x, over ? layout.curves.low.y : layout.time.low.y));
            EXPECT_EQ(layout.picture.size().x > 0, over);
        }
}

TEST(PanelLayout, LeavesRoomForThePictureWhereAllRowsAreOpen) {
    for (const glm::vec2 size : {glm::vec2(636, 360), glm::vec2(640, 480), glm::vec2(559, 400),
                                 glm::vec2(960, 540), glm::vec2(1280, 800)})
        for (int rows = 0; rows < 4; ++rows)
            EXPECT_TRUE(has_room_for_picture(
                layout_in(PanelPlace::over, size, {.film = rows % 2 == 1, .curves = rows / 2 == 1})
                    .picture,
                size))
                << size.x << ' ' << size.y << ' ' << rows;
    EXPECT_FALSE(has_room_for_picture({{40, 36}, {640, 100}}, {640, 360}));
    EXPECT_FALSE(has_room_for_picture({{300, 36}, {560, 300}}, {560, 360}));
}

/// What keys do at once, by the emulation that reads them.
std::set<Action> actions_of(const KeyCommand& command) {
    interaction::DesktopEmulation emulation({});
    emulation.poll(interaction::Seconds(0));
    const std::vector<interaction::WindowEvent> events = presses_of(command);
    emulation.feed(events);
    std::set<Action> actions;
    const interaction::InputState state = emulation.poll(interaction::Seconds(0.1));
    for (std::size_t number = 0; number < interaction::kActions; ++number)
        if (state.find("keys")->actions[number])
            actions.insert(static_cast<Action>(number));
    actions.erase(Action::shift);
    actions.erase(Action::control);
    return actions;
}

TEST(SearchedCommands, AreListedOnceAndPressTheKeyThatDoesThem) {
    std::set<std::string> seen;
    std::set<Action> done;
    for (const KeyCommand& command : key_commands()) {
        EXPECT_TRUE(seen.insert(command.words + command.name).second) << command.words;
        const std::set<Action> actions = actions_of(command);
        EXPECT_LE(actions.size(), 1u) << command.words;
        done.insert(actions.begin(), actions.end());
    }
    for (const Action action : {Action::play, Action::redo, Action::orthographic, Action::snap_clip,
                                Action::quality_paper, Action::undo, Action::next_surface,
                                Action::range_first, Action::ping_pong, Action::flip_clip})
        EXPECT_TRUE(done.contains(action)) << static_cast<int>(action);
}

} // namespace
} // namespace isochron::app
