// Numbers that are typed into the panel of a window, event by event.
#include "app/panel/panel_layer.h"
#include "stereo/context/gl_context.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

namespace isochron::app {
namespace {

using interaction::Commands;
using interaction::Key;
using interaction::KeyEvent;
using interaction::WindowEvent;

class TypedNumbers : public testing::Test {
  protected:
    TypedNumbers() {
        for (int step = 0; step < 2000; ++step)
            info_.times.push_back(step);
        stats_.low = 0;
        stats_.high = 100;
        stats_.histogram.assign(256, 1);
        asked_.panel = true;
    }

    Commands frame(const std::vector<WindowEvent>& events) {
        layer_.feed(events, true);
        time_ += interaction::Seconds(0.1);
        return layer_.lay_out(kSize,
                              {.info = info_,
                               .stats = stats_,
                               .asked = asked_,
                               .frame = report_,
                               .controls = controls_},
                              time_);
    }
    /// A click at a place of the window, and text that is typed then and entered.
    Commands typed_at(glm::vec2 at, const std::string& text) {
        frame({interaction::MouseMoveEvent{at.x, at.y, kSize.x, kSize.y}});
        frame({interaction::MouseButtonEvent{interaction::MouseButton::left, true}});
        frame({interaction::MouseButtonEvent{interaction::MouseButton::left, false}});
        frame({});
        Commands last;
        const auto see = [&](const Commands& commands) {
            if (commands.isovalue)
                asked_.set_isovalue(*(last.isovalue = commands.isovalue));
            if (commands.step)
                asked_.step = *(last.step = commands.step);
        };
        for (const char character : text)
            see(frame({interaction::TextEvent{static_cast<char32_t>(character)}}));
        see(frame({KeyEvent{Key::enter, true}, KeyEvent{Key::enter, false}}));
        see(frame({}));
        frame({KeyEvent{Key::escape, true}, KeyEvent{Key::escape, false}});
        frame({});
        return last;
    }

    static constexpr glm::ivec2 kSize{1000, 1000};
    std::unique_ptr<stereo::GlContext> context_ =
        stereo::make_context(stereo::ContextKind::egl, {.size = kSize});
    render::Gl gl_{context_->loader()};
    PanelLayer layer_{gl_};
    index::SeriesInfo info_;
    index::IndexStats stats_;
    ExplorerState asked_;
    FrameReport report_;
    std::vector<interaction::ControlGroup> controls_;
    interaction::Seconds time_{0};
};

TEST_F(TypedNumbers, ASingleClickBeginsThemAndTheyMayHaveADecimalCommaUnlessTheyAreWhole) {
    frame({});
    std::optional<glm::vec2> isovalue, step;
    const auto look = [&](glm::vec2 at) {
        const Commands commands = typed_at(at, "42");
        if (commands.isovalue == 42.0 && !isovalue)
            isovalue = at;
        if (commands.step == 41u && !step)
            step = at;
    };
    for (float y = 0.1f; y < 0.6f; y += 0.01f)
        look({0.1f, y}); // in the column of the sections
    for (float x = 0.2f; x < 0.5f; x += 0.02f)
        look({x, 0.974f}); // in the bar of the time
    ASSERT_TRUE(isovalue && step);
    EXPECT_EQ(typed_at(*isovalue, "1,5").isovalue, 1.5);
    EXPECT_EQ(typed_at(*isovalue, "1.5").isovalue, 1.5);
    EXPECT_EQ(typed_at(*isovalue, "1,234.5").isovalue, 1.5) << "it stays";
    typed_at(*step, "7");
    EXPECT_EQ(typed_at(*step, "1,500").step, 6u) << "it stays the seventh";
}

} // namespace
} // namespace isochron::app
