// Numbers that are typed into the panel of a window, event by event.
#include "tests/app/panel/layer_fixture.h"

#include <gmock/gmock.h>

#include <optional>
#include <string>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::Key;

class TypedNumbers : public LayerTest {
  protected:
    /// A click at a place of the window, and text that is typed then and entered.
    Commands typed_at(glm::vec2 at, const std::string& text) {
        click(at);
        Commands last;
        const auto see = [&](const Commands& commands) {
            if (commands.isovalue)
                asked_.set_isovalue(*(last.isovalue = commands.isovalue));
            if (commands.instant)
                asked_.instant = *(last.instant = commands.instant);
        };
        for (const char character : text)
            see(frame({interaction::TextEvent{static_cast<char32_t>(character)}}));
        see(frame(
            {interaction::KeyEvent{Key::enter, true}, interaction::KeyEvent{Key::enter, false}}));
        see(frame());
        press(Key::escape);
        return last;
    }
};

TEST_F(TypedNumbers, ASingleClickBeginsThemAndTheyMayHaveADecimalCommaUnlessTheyAreWhole) {
    frame();
    std::optional<glm::vec2> isovalue, step;
    const auto look = [&](glm::vec2 at) {
        const Commands commands = typed_at(at, "42");
        if (commands.isovalue == 42.0 && !isovalue)
            isovalue = at;
        if (commands.instant == index::Instant(41) && !step)
            step = at;
    };
    const PanelLayout layout = layer_.layout();
    for (float y = 411; y < 461; y += 9) // below the histogram
        look({130, y});
    for (float x = 200; x < 500; x += 20)
        look({x, (layout.time.low.y + layout.time.high.y) / 2});
    ASSERT_TRUE(isovalue && step);
    EXPECT_EQ(typed_at(*isovalue, "1,5").isovalue, 1.5);
    EXPECT_EQ(typed_at(*isovalue, "1.5").isovalue, 1.5);
    EXPECT_EQ(typed_at(*isovalue, "1,234.5").isovalue, 1.5) << "it stays";
    typed_at(*step, "7");
    EXPECT_EQ(typed_at(*step, "1,500").instant, index::Instant(6)) << "it stays the seventh";
}

} // namespace
} // namespace isochron::app
