// A user inside the process who does anything at random, with any devices: nothing crashes, memory
// stays as it was, and the recording replays to the same commands and pictures.
// ISOCHRON_SOAK_SECONDS in the environment says how long the user plays, two short sessions
// otherwise.
#include "tests/support/session_fixture.h"
#include "tests/support/test_seed.h"

#include "app/loop/replay.h"
#include "interaction/controls/desktop_emulation.h"

#include <glm/gtc/quaternion.hpp>
#include <gmock/gmock.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <random>

namespace isochron::app {
namespace {

using interaction::InputState;
using interaction::Key;

class RandomUser : public SessionTest {
  protected:
    /// Screenshots lie in the working directory.
    RandomUser() : before_(std::filesystem::current_path()) {
        std::filesystem::current_path(folder_.path());
    }
    ~RandomUser() override { std::filesystem::current_path(before_); }

    unsigned any(unsigned count) { return random_() % count; }
    float from(float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random_);
    }

    Config any_config() {
        const std::vector<stereo::StereoMode> modes = stereo::all_stereo_modes();
        Config config = small_config(modes[any(unsigned(modes.size()))]);
        stereo::Window& window = config.installation.windows.front();
        window.size = {int(16 + any(120)), int(16 + any(90))};
        config.start.quality = interaction::QualityMode(any(4));
        config.rendering.samples = int(1 + any(2) * 3);
        return config;
    }

    std::vector<interaction::WindowEvent> any_events() {
        std::vector<interaction::WindowEvent> events;
        for (unsigned i = any(4); i > 0; --i)
            switch (any(6)) {
            case 0:
                events.push_back(
                    interaction::MouseMoveEvent{from(-0.1f, 1.1f), from(-0.1f, 1.1f), 640, 480});
                break;
            case 1:
                events.push_back(
                    interaction::MouseButtonEvent{interaction::MouseButton(any(3)), any(2) == 0});
                break;
            case 2: events.push_back(interaction::ScrollEvent{from(-3, 3), from(-3, 3)}); break;
            case 3:
                if (any(8) == 0)
                    events.push_back(interaction::FocusEvent{any(2) == 0});
                else
                    events.push_back(
                        interaction::GamepadEvent{any(9) != 0,
                                                  {from(-1, 1), from(-1, 1), from(-1, 1),
                                                   from(-1, 1), from(-1, 1), from(-1, 1)},
                                                  std::uint32_t(random_())});
                break;
            default: events.push_back(interaction::KeyEvent{Key(any(350)), any(3) != 0});
            }
        return events;
    }

    /// Any state that a tracker may report, or none.
    interaction::DeviceState any_device(const std::string& name) {
        interaction::DeviceState device;
        device.name = name;
        if (any(5) != 0) {
            const glm::quat turn(from(-1, 1), from(-1, 1), from(-1, 1), from(-1, 1));
            device.pose = interaction::Pose{{from(-2, 2), from(0, 2.5f), from(-3, 1)},
                                            glm::normalize(turn + glm::quat(0.01f, 0, 0, 0))};
        }
        device.pose_valid = device.pose && any(4) != 0;
        device.pose_lost = !device.pose_valid && any(2) == 0;
        device.buttons = any(3) == 0 ? random_() % 32768 : 0;
        for (unsigned i = any(7); i > 0; --i)
            device.valuators.push_back(from(-1, 1));
        return device;
    }

    InputState any_input(interaction::DesktopEmulation& emulation, double seconds) {
        emulation.feed(any_events());
        InputState input = emulation.poll(interaction::Seconds(seconds));
        if (tracked_) // instead of what mouse and keyboard play
            for (const char* name : {"head", "wand", "wand2", "camera"})
                if (any(3) == 0) {
                    std::erase_if(input.devices,
                                  [&](const auto& device) { return device.name == name; });
                    input.devices.push_back(any_device(name));
                }
        return input;
    }

    /// What the whole process takes now [KiB].
    static long memory() {
        std::ifstream status("/proc/self/status");
        for (std::string line; std::getline(status, line);)
            if (line.starts_with("VmRSS:"))
                return std::atol(line.c_str() + 6);
        return 0;
    }

    /// Plays a session, and replays it. @return how many frames
    std::size_t play(int frames) {
        const Config config = any_config();
        tracked_ = any(2) == 0;
        interaction::Recording recording;
        std::vector<std::uint8_t> last;
        {
            Session session(config, file_, *context_);
            recording.header.start = session.state().as_commands();
            interaction::DesktopEmulation emulation({});
            for (int i = 0; i < frames && !session.should_close(); ++i) {
                interaction::RecordedFrame frame;
                frame.input = any_input(emulation, i / 30.0);
                frame.commands = session.commands_from(frame.input);
                frame.from_panel = session.take_panel_commands();
                interaction::merge(frame.commands, frame.from_panel);
                session.frame(frame.input, frame.commands, Waiting::for_cells);
                recording.frames.push_back(frame);
            }
            last = session.outputs().display().read_window().rgba;
        }
        Session again(config, file_, *context_);
        again.set_state(start_of(recording.header, again.state(), file_->info().steps(), {}));
        const auto different =
            replay_fixed_step(again, recording, {.from_devices = true, .stereo = {}, .quality = {}},
                              [](std::size_t, const auto&) {});
        EXPECT_THAT(different, testing::IsEmpty());
        EXPECT_EQ(again.outputs().display().read_window().rgba, last);
        return recording.frames.size();
    }

    const std::filesystem::path before_;
    std::mt19937 random_{test_seed()};
    bool tracked_ = false;
};

TEST_P(RandomUser, IsFollowedAndReplayedInConstantMemory) {
    using Clock = std::chrono::steady_clock;
    const char* seconds = std::getenv("ISOCHRON_SOAK_SECONDS");
    const auto end = Clock::now() + std::chrono::seconds(seconds ? std::atoi(seconds) : 0);
    std::size_t frames = play(80) + play(80);
    long first = 0;
    for (int session = 0; Clock::now() < end && !HasFailure(); ++session) {
        if (session == 10) // caches are full by then
            first = memory();
        frames += play(80);
    }
    EXPECT_GT(frames, 100u);
    if (first > 0) {
        EXPECT_LT(memory(), first + first / 2);
    }
}

INSTANTIATE_TEST_SUITE_P(, RandomUser, testing::Values(stereo::ContextKind::egl), context_name);

} // namespace
} // namespace isochron::app
