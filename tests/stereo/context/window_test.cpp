// Windows on the test's own X server: their contents, and what a user does to them.
#include "stereo/context/display_loss.h"
#include "stereo/display.h"
#include "tests/stereo/each_eye.h"
#include "tests/support/eventually.h"
#include "tests/support/virtual_display.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <optional>

namespace isochron::stereo {
namespace {

using namespace interaction;

constexpr glm::ivec2 kPosition{100, 50}, kSize{640, 480};

class WindowTest : public testing::Test {
  protected:
    std::unique_ptr<GlContext> open(const std::string& title) {
        return make_context(ContextKind::glfw,
                            {.size = kSize, .position = kPosition, .title = title});
    }
    /// Polls until the condition holds; the X server answers when it likes, a loaded one late.
    bool eventually(GlContext& context, const std::function<bool()>& holds) {
        return test_support::eventually([&] {
            for (const WindowEvent& event : context.poll_events())
                events_.push_back(event);
            return holds();
        });
    }
    template <typename Event>
    std::vector<Event> received(const std::function<bool(const Event&)>& wanted) const {
        std::vector<Event> found;
        for (const WindowEvent& event : events_)
            if (const Event* candidate = std::get_if<Event>(&event);
                candidate && wanted(*candidate))
                found.push_back(*candidate);
        return found;
    }
    auto keys(Key key, bool down) const {
        return received<KeyEvent>(
            [=](const KeyEvent& event) { return event.key == key && event.down == down; });
    }

    test_support::VirtualDisplay screen_;
    std::vector<WindowEvent> events_;
};

TEST_F(WindowTest, HasAGl45CoreContextOfTheWantedSize) {
    const auto context = open("size");
    EXPECT_TRUE(context->has_window());
    EXPECT_FALSE(context->should_close());
    EXPECT_EQ(context->framebuffer_size(), kSize);
    EXPECT_THAT(context->description(), testing::StartsWith("GLFW, OpenGL 4."));
    const render::Gl gl(context->loader());
    GLint profile = 0;
    gl.GetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    EXPECT_TRUE(profile & GL_CONTEXT_CORE_PROFILE_BIT);
}

TEST_F(WindowTest, TheDisplayStaysOpenFromOneWindowToTheNextWhileItIsHeld) {
    auto context = open("first");
    auto held = open_display();
    EXPECT_TRUE(held);
    context.reset();
    EXPECT_EQ(open_display(), held);
    context = open("second");
    EXPECT_EQ(open_display(), held);
    context.reset();
    held.reset();
    EXPECT_FALSE(open_display());
}

TEST_F(WindowTest, ShowsTheLeftEyeAtTheLeftAndTheOverlayAtTheTop) {
    const auto context = open("shown");
    const render::Gl gl(context->loader());
    Display display(gl, *context, {}, {});
    const auto draw = [&] {
        draw_each_eye(
            gl, display, {}, 0.06f, StereoMode::side_by_side,
            [&](const render::View&, Eye eye) {
                gl.ClearColor(eye == Eye::left, eye == Eye::right, 0, 1);
                gl.Clear(GL_COLOR_BUFFER_BIT);
            },
            [&](glm::ivec2 size) {
                gl.Enable(GL_SCISSOR_TEST);
                gl.Scissor(0, size.y - 20, size.x, 20);
                gl.ClearColor(0, 0, 1, 1);
                gl.Clear(GL_COLOR_BUFFER_BIT);
            });
        display.present();
    };
    using Rgb = std::array<int, 3>;
    const auto shows = [&](int x, int y, Rgb color) {
        return eventually(*context, [&] {
            draw();
            return screen_.pixel(kPosition.x + x, kPosition.y + y) == color;
        });
    };
    EXPECT_TRUE(shows(310, 240, {255, 0, 0}));
    EXPECT_TRUE(shows(330, 240, {0, 255, 0}));
    EXPECT_TRUE(shows(330, 10, {0, 0, 255}));
    EXPECT_TRUE(shows(10, 475, {255, 0, 0}));
}

TEST_F(WindowTest, KeysAndTextArriveAndRepeatsDoNotPressAgain) {
    const auto context = open("keys");
    screen_.xdotool({"mousemove", "300", "200"});
    screen_.xdotool({"keydown", "a"});
    // The server's own auto-repeat types on while the key is held.
    EXPECT_TRUE(eventually(*context, [&] {
        return received<TextEvent>([](const TextEvent& e) { return e.character == U'a'; }).size() >
               2;
    }));
    screen_.xdotool({"keyup", "a"});
    EXPECT_TRUE(eventually(*context, [&] { return !keys(static_cast<Key>('A'), false).empty(); }));
    EXPECT_EQ(keys(static_cast<Key>('A'), true).size(), 1u);
    EXPECT_EQ(keys(static_cast<Key>('A'), false).size(), 1u);

    screen_.xdotool({"key", "Escape", "Page_Up", "F5", "shift+bracketleft", "KP_Add"});
    EXPECT_TRUE(eventually(*context, [&] { return !keys(Key::equal, false).empty(); }));
    for (const Key key : {Key::escape, Key::page_up, Key::f5, Key::left_bracket, Key::left_shift})
        EXPECT_EQ(keys(key, true).size(), 1u) << static_cast<int>(key);
}

TEST_F(WindowTest, KeysComeWithTheModifiersThatAreHeld) {
    const auto context = open("modifiers");
    screen_.xdotool({"mousemove", "300", "200", "key", "ctrl+c", "alt+v", "super+b", "ctrl+alt+n",
                     "shift+m", "Escape"});
    EXPECT_TRUE(eventually(*context, [&] { return !keys(Key::escape, false).empty(); }));
    const auto modifiers = [&](char letter) {
        const auto pressed = keys(static_cast<Key>(letter), true);
        return pressed.size() == 1 ? static_cast<int>(pressed.front().modifiers) : -1;
    };
    EXPECT_EQ(modifiers('C'), 1);
    EXPECT_EQ(modifiers('V'), 2);
    EXPECT_EQ(modifiers('B'), 4);
    EXPECT_EQ(modifiers('N'), 3);
    EXPECT_EQ(modifiers('M'), 0);
    std::u32string typed;
    for (const TextEvent& text : received<TextEvent>([](const TextEvent&) { return true; }))
        typed += text.character;
    EXPECT_EQ(typed, U"M") << "what goes with Ctrl, Alt and Super is no text";
}

TEST_F(WindowTest, TheCursorIsAFractionOfTheWindow) {
    const auto context = open("mouse");
    screen_.xdotool({"mousemove", "260", "410"}); // 160 and 360 pixels into the window
    screen_.xdotool({"click", "1", "click", "3", "click", "4", "click", "5"});
    const auto clicks = [&](MouseButton button, bool down) {
        return received<MouseButtonEvent>([=](const MouseButtonEvent& event) {
            return event.button == button && event.down == down;
        });
    };
    const auto scrolls = [&] {
        return received<ScrollEvent>([](const ScrollEvent&) { return true; });
    };
    EXPECT_TRUE(eventually(*context, [&] { return scrolls().size() >= 2; }));
    EXPECT_EQ(clicks(MouseButton::left, true).size(), 1u);
    EXPECT_EQ(clicks(MouseButton::left, false).size(), 1u);
    EXPECT_EQ(clicks(MouseButton::right, true).size(), 1u);
    EXPECT_EQ(scrolls()[0].dy, 1);
    EXPECT_EQ(scrolls()[1].dy, -1);
    const auto moves = received<MouseMoveEvent>([](const MouseMoveEvent&) { return true; });
    ASSERT_FALSE(moves.empty());
    EXPECT_NEAR(moves.back().x, 0.25, 1e-6);
    EXPECT_NEAR(moves.back().y, 0.75, 1e-6);
    EXPECT_EQ(glm::ivec2(moves.back().width, moves.back().height), kSize);
}

TEST_F(WindowTest, ResizesAndAsksToClose) {
    const auto context = open("resized");
    const render::Gl gl(context->loader());
    Display display(gl, *context, {}, {});
    screen_.resize_window("resized", 500, 300);
    EXPECT_TRUE(
        eventually(*context, [&] { return context->framebuffer_size() == glm::ivec2(500, 300); }));
    draw_each_eye(gl, display, {}, 0, StereoMode::mono, [](const render::View& view, Eye) {
        EXPECT_EQ(view.size, glm::ivec2(500, 300));
    });
    display.present();
    EXPECT_FALSE(context->should_close());
    screen_.close_window("resized");
    EXPECT_TRUE(eventually(*context, [&] { return context->should_close(); }));
}

TEST_F(WindowTest, FillsTheMonitorWhenFullscreenAndNamesOneThatDoesNotExist) {
    {
        const auto context = make_context(ContextKind::glfw, {.size = kSize, .fullscreen = true});
        EXPECT_TRUE(eventually(
            *context, [&] { return context->framebuffer_size() == glm::ivec2(1280, 1024); }));
    }
    try {
        make_context(ContextKind::glfw, {.fullscreen = true, .monitor = 7});
        FAIL() << "found monitor 7";
    } catch (const render::Error& error) {
        EXPECT_STREQ(error.what(), "context glfw: monitor 7 does not exist, there is 1; other "
                                   "contexts: egl, osmesa");
    }
}

TEST_F(WindowTest, TwoWindowsShareOneInitialization) {
    const auto first = open("first");
    {
        const auto second = open("second");
        screen_.close_window("second");
        EXPECT_TRUE(eventually(*second, [&] { return second->should_close(); }));
    }
    EXPECT_FALSE(first->should_close());
    first->make_current();
    EXPECT_THAT(first->description(), testing::StartsWith("GLFW, OpenGL 4."));
}

TEST(Window, WithoutADisplayTheErrorSaysSoAndNamesWhatWorks) {
    unsetenv("DISPLAY");
    try {
        make_context(ContextKind::glfw, {});
        FAIL() << "opened a window without a display";
    } catch (const render::Error& error) {
        EXPECT_THAT(error.what(), testing::StartsWith("no display"));
        EXPECT_THAT(error.what(), testing::HasSubstr("DISPLAY"));
        EXPECT_THAT(error.what(), testing::HasSubstr("`isochron replay` draws pictures"));
        EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("contexts")));
        EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
    }
}

} // namespace
} // namespace isochron::stereo
