// Heads right before drawing: they are used in the views and the recording, and nowhere else.
#include "app/frame/late_latch.h"

#include "tests/support/session_fixture.h"

#include "app/loop/replay.h"

namespace isochron::app {
namespace {

using interaction::DeviceState;
using interaction::InputState;
using interaction::Seconds;
using stereo::Eye;

DeviceState device(std::string name, float x, std::optional<double> measured = {}) {
    DeviceState state{.name = std::move(name), .pose = std::nullopt, .valuators = {}};
    state.pose = interaction::Pose{{x, 1.5f, 0.0f}, {1, 0, 0, 0}};
    if (measured)
        state.measured = Seconds(*measured);
    return state;
}

TEST(LateLatch, TakesOverTheViewersHeadsAndNoHands) {
    stereo::Installation installation;
    installation.viewers = {{.name = "a", .head = "head"}, {.name = "b", .head = "other head"}};
    const InputState input{Seconds(1), {device("head", 0, 0.9), device("wand", 0, 0.9)}};
    InputState latched{Seconds(1.02), {device("wand", 5, 1.01), device("head", 6, 1.01)}};
    latched.devices.push_back(device("other head", 7)); // seen for the first time, and not dated
    latched.devices.push_back({.name = "other head", .pose = std::nullopt, .valuators = {}});
    const InputState heads = viewers_heads(latched, installation);
    ASSERT_EQ(heads.devices.size(), 2u);
    const InputState seen = with_heads(input, heads);
    EXPECT_EQ(seen.find("head")->pose->position.x, 6);
    EXPECT_EQ(seen.find("wand")->pose->position.x, 0);
    EXPECT_EQ(seen.find("other head")->pose->position.x, 7);
    EXPECT_NEAR(pose_age(seen, Seconds(1.02), installation)->count(), 0.01, 1e-9) << "the oldest";
    EXPECT_NEAR(pose_age(input, Seconds(1.02), installation)->count(), 0.12, 1e-9);
    EXPECT_EQ(pose_age({}, Seconds(1.02), installation), std::nullopt);
    const InputState emulated{Seconds(1), {device("head", 0)}};
    EXPECT_NEAR(pose_age(emulated, Seconds(1.02), installation)->count(), 0.02, 1e-9);
}

class LateLatchTest : public SessionTest {};

TEST_P(LateLatchTest, AgesAndLatenciesAreThoseOfTheClock) {
    Session session(small_config(), file_, *context_);
    session.set_clock([] { return Seconds(2.030); });
    InputState input = head_at_rest(2.0);
    input.devices.front().measured = Seconds(1.995);
    const FrameReport& frame = session.frame(input, {}, Waiting::for_cells, [] {
        return InputState{Seconds(2.020), {device("head", 0.1f, 2.013)}};
    });
    EXPECT_NEAR(frame.pose_age->count(), 7, 1e-6);
    EXPECT_NEAR(frame.latency.count(), 30, 1e-6);
    const FrameReport& unlatched = session.frame(input, {}, Waiting::for_cells);
    EXPECT_NEAR(unlatched.pose_age->count(), 5, 1e-6);
    EXPECT_TRUE(session.latched().devices.empty());
}

TEST_P(LateLatchTest, AskedOnceBehindTheUploadAndOnlyForTheViews) {
    Session session(small_config(), file_, *context_);
    for (int i = 0; i < 30; ++i) {
        int asked = 0;
        const FrameReport& frame =
            session.frame(head_at_rest(i / 60.0), {}, Waiting::for_cells, [&] {
                ++asked;
                // A head that the motion gate would call moving, were it told.
                return InputState{Seconds(i / 60.0), {device("head", i % 2 ? 0.2f : -0.2f)}};
            });
        EXPECT_EQ(asked, 1);
        EXPECT_TRUE(frame.redrawn);
        if (i == 29) {
            EXPECT_EQ(frame.pace, interaction::Pace::settled);
        }
    }
}

TEST_P(LateLatchTest, AReplayDrawsWhatWasLatched) {
    interaction::Recording recording;
    render::Image drawn;
    {
        Session session(small_config(), file_, *context_);
        recording.header.start = session.state().as_commands();
        for (int i = 0; i < 3; ++i) {
            const InputState input = head_at_rest(i / 60.0);
            session.frame(input, {}, Waiting::for_cells, [&] {
                return InputState{input.time, {device("head", 0.1f * static_cast<float>(i + 1))}};
            });
            recording.frames.push_back({input, {}, {}, "", session.latched()});
        }
        drawn = session.outputs().display().read_eye(Eye::left);
    }
    const auto replayed = [&] {
        Session session(small_config(), file_, *context_);
        replay_fixed_step(session, recording, {}, [](std::size_t, const auto&) {});
        return session.outputs().display().read_eye(Eye::left).rgba;
    };
    EXPECT_EQ(replayed(), drawn.rgba);
    recording.frames.back().latched = {};
    EXPECT_NE(replayed(), drawn.rgba);
}

INSTANTIATE_TEST_SUITE_P(, LateLatchTest,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

} // namespace
} // namespace isochron::app
