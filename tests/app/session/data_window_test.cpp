// The window of an explorer without data, on a stand-in for a desktop.
#include "tests/support/session_fixture.h"

#include "app/loop/data_window.h"

#include <gmock/gmock.h>

#include <set>
#include <utility>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;
using interaction::Key;
using interaction::KeyEvent;
using interaction::MouseButton;
using interaction::MouseButtonEvent;
using interaction::MouseMoveEvent;
using interaction::WindowEvent;

constexpr glm::ivec2 kPlayed(640, 480);

/// A window whose user does in each frame what the test says.
class PlayedWindow final : public stereo::GlContext {
  public:
    using Frame = std::function<void(std::vector<WindowEvent>&, std::vector<fs::path>& dropped)>;
    explicit PlayedWindow(Frame frame)
        : context_(stereo::make_context(stereo::ContextKind::egl, {.size = kPlayed})),
          frame_(std::move(frame)) {}
    void make_current() override { context_->make_current(); }
    render::GlLoader loader() const override { return context_->loader(); }
    glm::ivec2 framebuffer_size() const override { return kPlayed; }
    bool has_window() const override { return true; }
    void present() override {}
    bool should_close() const override { return false; }
    std::vector<WindowEvent> poll_events() override {
        std::vector<WindowEvent> events;
        frame_(events, dropped_);
        return events;
    }
    std::vector<fs::path> take_dropped() override { return std::exchange(dropped_, {}); }
    std::string description() const override { return "played"; }

  private:
    std::unique_ptr<stereo::GlContext> context_;
    Frame frame_;
    std::vector<fs::path> dropped_;
};

class DataWindowTest : public testing::Test {
  protected:
    DataWindowTest() {
        build_sphere(folder_.path());
        fs::create_directory(folder_.path() / "deeper");
        fs::rename(folder_.path() / "sphere.isochron", folder_.path() / "deeper/sphere.isochron");
        folder_.write("lately.isochron", "");
    }
    /// @param frames after which nobody chooses any more
    std::optional<fs::path> choose(const PlayedWindow::Frame& frame, int frames,
                                   std::string complaint = {}) {
        PlayedWindow window(frame);
        const stereo::Windows windows(window);
        return choose_data(
            windows, {.recent = {folder_.path() / "lately.isochron"},
                      .why_not_open =
                          [&](const fs::path& data) {
                              asked_.insert(data.filename().string());
                              return data == good_ ? std::string() : complaint;
                          },
                      .window = {.ended = [&] { return --frames < 0; }, .frame_rate_limit = 1e6}});
    }
    /// Double clicks on one line of the window after another, from below; all four changes of the
    /// button come in one frame, as from a fast hand.
    PlayedWindow::Frame double_clicks() {
        return [at = 430.0f, part = 0](std::vector<WindowEvent>& events, auto&) mutable {
            events.emplace_back(MouseMoveEvent{0.4f, at / kPlayed.y, kPlayed.x, kPlayed.y});
            if (part == 2)
                for (const bool down : {true, false, true, false})
                    events.emplace_back(MouseButtonEvent{MouseButton::left, down});
            if (part = (part + 1) % 8; part == 0)
                at = at > 60 ? at - 9 : 430.0f;
        };
    }
    /// Types keys one frame after the other, once the window is there.
    static PlayedWindow::Frame types(std::vector<WindowEvent> typed) {
        return [typed = std::move(typed), frames = std::size_t{0}](std::vector<WindowEvent>& events,
                                                                   auto&) mutable {
            const std::size_t at = frames++ / 3;
            if (frames % 3 == 0 && at > 1 && at - 2 < typed.size()) {
                events.push_back(typed[at - 2]);
                if (const auto* key = std::get_if<KeyEvent>(&typed[at - 2]))
                    events.emplace_back(KeyEvent{key->key, false});
            }
        };
    }

    TestFolder folder_;
    fs::path good_ = folder_.path() / "deeper/sphere.isochron";
    std::set<std::string> asked_; ///< whether it could be opened
};

TEST_F(DataWindowTest, TakesOfTheRecentDataWhatIsClickedTwice) {
    good_ = folder_.path() / "lately.isochron";
    EXPECT_EQ(choose(double_clicks(), 4000, "no index"), good_);
    EXPECT_THAT(asked_, testing::ElementsAre("lately.isochron"));
}

TEST_F(DataWindowTest, AKeyboardAloneGoesThroughTheFolders) {
    // The recent data are listed first: Backspace leads to their folder, a second one around it.
    std::vector<WindowEvent> typed(2, KeyEvent{Key::backspace, true});
    const auto type = [&](const std::string& words) {
        for (const char character : words)
            typed.emplace_back(interaction::TextEvent{static_cast<char32_t>(character)});
        typed.emplace_back(KeyEvent{Key::enter, true});
    };
    type(folder_.path().filename().string());
    type("deep");
    type("SPHERE");
    EXPECT_EQ(choose(types(typed), 4000, "no index"), good_);
    EXPECT_THAT(asked_, testing::ElementsAre("sphere.isochron"));
}

TEST_F(DataWindowTest, DoubleClicksGoThroughTheFoldersAndTakeWhatCanBeOpened) {
    const auto clicks = double_clicks();
    const auto back = types({KeyEvent{Key::backspace, true}}); // to the folder of the recent data
    const auto chosen = choose(
        [&, frames = 0](std::vector<WindowEvent>& events, auto& dropped) mutable {
            if (frames++ < 20)
                back(events, dropped);
            else
                clicks(events, dropped);
        },
        4000, "no index");
    EXPECT_EQ(chosen, good_);
    EXPECT_TRUE(asked_.contains("lately.isochron")) << "which is none, and was said to be none";
}

TEST_F(DataWindowTest, TakesTheFileThatIsDropped) {
    const auto chosen = choose(
        [&, n = 0](auto&, auto& dropped) mutable {
            if (++n == 3)
                dropped.push_back(folder_.path() / "lately.isochron");
            else if (n == 6)
                dropped.push_back(good_);
        },
        100, "no index");
    EXPECT_EQ(chosen, good_);
    EXPECT_THAT(asked_, testing::ElementsAre("lately.isochron", "sphere.isochron"));
}

TEST_F(DataWindowTest, EscapeAndTheEndOfTheProgramChooseNothing) {
    int frames = 0;
    EXPECT_FALSE(choose(
        [&](std::vector<WindowEvent>& events, auto&) {
            if (++frames == 5)
                events.emplace_back(KeyEvent{Key::escape, true});
        },
        1000));
    EXPECT_LT(frames, 20);
    EXPECT_FALSE(choose([](auto&, auto&) {}, 3));
}

TEST_F(DataWindowTest, FilesThatAreDroppedTogetherAreTakenAsASeries) {
    fs::create_directory(folder_.path() / "runs");
    for (const char* name : {"t8.vti", "t9.vti", "t10.vti"})
        folder_.write(std::string("runs/") + name, "");
    const auto dropped = choose(
        [&, n = 0](auto&, auto& files) mutable {
            if (++n == 2)
                files = {folder_.path() / "runs/t8.vti", folder_.path() / "runs/t10.vti"};
            else if (n == 4)
                for (const char* name : {"runs/t9.vti", "runs/t10.vti", "runs/t8.vti"})
                    files.push_back(folder_.path() / name);
        },
        100);
    EXPECT_EQ(dropped, folder_.path() / "runs/t[0-9]*.vti") << "two of three have no one name";
}

TEST_F(DataWindowTest, AnArrayOfSeveralShapesIsChosenByKeysAndByADoubleClick) {
    const std::vector<ListedArray> arrays{{"rho", "64 x 64 x 64, 3 steps", "kg", "0 to 2", ""},
                                          {"worse", "", "", "", "complex values"},
                                          {"speed", "32 x 32 x 32, 3 steps", "m/s", "", ""}};
    const auto choose_by = [&](std::size_t first, const PlayedWindow::Frame& frame) {
        PlayedWindow window(frame);
        const stereo::Windows windows(window);
        std::optional<std::size_t> chosen;
        int asked = 0;
        const Waited end = wait_for_data(
            windows, "run.h5",
            [&] {
                return DataProgress{
                    .ready = chosen.has_value() || ++asked > 400, .line = "", .arrays = arrays};
            },
            {.frame_rate_limit = 1e6},
            {.first = [&] { return first; }, .choose = [&](std::size_t one) { chosen = one; }});
        EXPECT_EQ(end, Waited::ready);
        return chosen;
    };
    const KeyEvent enter{Key::enter, true}, down{Key::down, true}, up{Key::up, true};
    EXPECT_EQ(choose_by(0, types({enter})), 0u);
    EXPECT_EQ(choose_by(2, types({enter})), 2u) << "the one that was chosen last";
    EXPECT_EQ(choose_by(0, types({down, enter, down, enter})), 2u) << "one cannot be shown";
    EXPECT_EQ(choose_by(2, types({up, up, enter})), 0u);
    EXPECT_TRUE(choose_by(0, double_clicks()));
    PlayedWindow window([n = 0](std::vector<WindowEvent>& events, auto&) mutable {
        if (++n == 5)
            events.emplace_back(KeyEvent{Key::escape, true});
    });
    const stereo::Windows windows(window);
    EXPECT_EQ(
        wait_for_data(windows, "run.h5",
                      [&] { return DataProgress{.ready = false, .line = "", .arrays = arrays}; },
                      {.frame_rate_limit = 1e6}),
        Waited::canceled);
}

TEST_F(DataWindowTest, WaitsForDataThatAreBeingIndexedUntilTheyCanBeShown) {
    int asked = 0;
    const auto wait = [&](int ready, const PlayedWindow::Frame& frame) {
        PlayedWindow window(frame);
        const stereo::Windows windows(window);
        asked = 0;
        return wait_for_data(
            windows, "t0.vti",
            [&] {
                return DataProgress{++asked >= ready, "reading", 0.01f * static_cast<float>(asked)};
            },
            {.frame_rate_limit = 1e6});
    };
    EXPECT_EQ(wait(5, [](auto&, auto&) {}), Waited::ready);
    EXPECT_EQ(asked, 5);
    EXPECT_EQ(wait(1000,
                   [&](std::vector<WindowEvent>& events, auto&) {
                       if (asked == 7)
                           events.emplace_back(KeyEvent{Key::escape, true});
                   }),
              Waited::canceled);
    EXPECT_LT(asked, 20);
}

} // namespace
} // namespace isochron::app
