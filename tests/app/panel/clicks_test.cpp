// What is done most often takes one click on the panel, and no search for it.
#include "tests/app/panel/layer_fixture.h"

#include "app/panel/parts/key_search.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <utility>
#include <variant>
#include <vector>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::Key;
using interaction::KeyEvent;

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

TEST_F(Clicks, OneLeadsToTheNextStepASecondSurfaceAndAPicture) {
    frame();
    const PanelPlaces places = layer_.places();
    const float middle = (places.time.low.y + places.time.high.y) / 2;
    EXPECT_TRUE(one_click({0, middle}, {300, middle},
                          [](const Commands& commands) { return commands.step == 1u; }));
    EXPECT_TRUE(one_click({23, 420}, {23, 380}, [](const Commands& commands) {
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
    const glm::vec2 corner = layer_.places().picture.low;
    EXPECT_TRUE(one_click(corner + glm::vec2(60, 24), corner + glm::vec2(400, 24), clips_along_x));
}

TEST_F(Clicks, ALineOfTheHistogramIsTakenWhereTheHandIsAndPicksItsSurface) {
    asked_.isosurfaces = {{20, {1, 0, 0}, 1}, {80, {0, 1, 0}, 1}};
    frame();
    // From 12 to 288 lie the values 0 to 100.
    const auto place_of = [](float value) { return glm::vec2(12 + 2.76f * value, 280); };
    const Commands near_second = click(place_of(81));
    EXPECT_EQ(near_second.picked, 1u);
    EXPECT_NEAR(near_second.isovalue.value_or(0), 81, 0.5);
    const Commands nearer_first = click(place_of(21));
    EXPECT_FALSE(nearer_first.picked) << "it is picked";
    EXPECT_NEAR(nearer_first.isovalue.value_or(0), 21, 0.5);
    EXPECT_NEAR(click(place_of(50)).isovalue.value_or(0), 50, 0.5) << "the picked one comes there";
}

TEST_F(Clicks, TheCubeTurnsTheDataToTheFaceThatIsClicked) {
    asked_.room_from_physical.translation = {0, 0, -3};
    info_.grid.vertices = {2, 2, 2};
    frame();
    const PanelBox picture = layer_.places().picture;
    const Commands commands = click({picture.high.x - 54, picture.low.y + 52});
    ASSERT_TRUE(commands.room_from_physical);
    const glm::dvec3 up = commands.room_from_physical->rotation * glm::dvec3(0, 0, 1);
    EXPECT_NEAR(up.z, 1, 1e-6) << "+z looks at the viewer";
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

} // namespace
} // namespace isochron::app
