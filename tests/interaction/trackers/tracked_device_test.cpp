// One device over time: prediction, buttons that never stay pressed, time stamps, several sources.
#include "interaction/controls/motion_gate.h"
#include "interaction/input/composite_input.h"
#include "interaction/trackers/device_clock.h"
#include "interaction/trackers/frame_sequence.h"
#include "interaction/trackers/tracked_device.h"

#include "tests/interaction/controls/control_desk.h"
#include "tests/support/test_seed.h"

#include <cmath>
#include <cstdio>

namespace isochron::interaction {
namespace {

DeviceOptions head_options(bool prediction = true) {
    DeviceOptions options;
    options.name = "head";
    options.prediction.on = prediction;
    return options;
}

/// A head that looks about and leans: 0.5 m/s and 2 rad/s at its fastest.
Pose looking_about(double t) {
    const float yaw = static_cast<float>(0.6 * std::sin(3.3 * t));
    return {glm::vec3(0.2 * std::sin(2.5 * t), 1.6 + 0.05 * std::sin(4.0 * t), 0.1 * std::cos(t)),
            glm::angleAxis(yaw, glm::vec3(0, 1, 0))};
}

struct Errors {
    double linear = 0, angular = 0; ///< root mean square [m], [rad]
};

/// Tracked at `rate` with noise, drawn at 60 Hz; how far the stated pose is from where the head is
/// when the picture is seen.
Errors errors_of(const DeviceOptions& options, double rate, double noise, bool tells_velocity) {
    Random random(test_seed());
    std::normal_distribution<float> jitter(0.0f, static_cast<float>(noise));
    TrackedDevice device(options);
    Errors sum;
    int frames = 0;
    double sampled = 0;
    for (int frame = 1; frame <= 600; ++frame) {
        const double now = frame / 60.0;
        while (sampled <= now) {
            Pose pose = looking_about(sampled);
            pose.position += glm::vec3(jitter(random), jitter(random), jitter(random));
            std::optional<Velocity> velocity;
            if (tells_velocity) {
                const Pose next = looking_about(sampled + 1e-4);
                velocity = Velocity{
                    glm::dvec3(next.position - looking_about(sampled).position) / 1e-4,
                    rotation_between(looking_about(sampled).orientation, next.orientation) / 1e-4};
            }
            device.add_pose(Seconds(sampled), pose, velocity);
            sampled += 1 / rate;
        }
        const DeviceState state = device.poll(Seconds(now));
        if (frame < 30)
            continue;
        const Pose truth = looking_about(now + options.prediction.display_delay.count());
        const double off = glm::length(glm::dvec3(state.pose->position - truth.position));
        const double turned =
            glm::length(rotation_between(state.pose->orientation, truth.orientation));
        sum.linear += off * off;
        sum.angular += turned * turned;
        ++frames;
    }
    return {std::sqrt(sum.linear / frames), std::sqrt(sum.angular / frames)};
}

TEST(Prediction, ErrorIsAFractionOfTheLag) {
    for (const double rate : {60.0, 120.0}) {
        const Errors lag = errors_of(head_options(false), rate, 0.0002, false);
        const Errors predicted = errors_of(head_options(), rate, 0.0002, false);
        const Errors told = errors_of(head_options(), rate, 0.0002, true);
        std::printf("%g Hz: lag %.2f mm %.2f deg, predicted %.2f mm %.2f deg, with the device's "
                    "velocity %.2f mm\n",
                    rate, 1e3 * lag.linear, 57.3 * lag.angular, 1e3 * predicted.linear,
                    57.3 * predicted.angular, 1e3 * told.linear);
        EXPECT_GT(lag.linear, 0.007);
        EXPECT_LT(predicted.linear, 0.25 * lag.linear);
        EXPECT_LT(predicted.angular, 0.25 * lag.angular);
        EXPECT_LT(told.linear, 0.2 * lag.linear);
    }
}

TEST(Prediction, OffStatesTheMeasuredPose) {
    TrackedDevice device(head_options(false));
    for (int i = 0; i <= 10; ++i)
        device.add_pose(Seconds(0.01 * i), {{0.02f * static_cast<float>(i), 0, 0}, {1, 0, 0, 0}});
    const DeviceState state = device.poll(Seconds(0.11));
    EXPECT_EQ(state.pose->position.x, 0.02f * 10);
    EXPECT_NEAR(state.velocity->linear.x, 2, 1e-4);
    EXPECT_EQ(*state.measured, Seconds(0.1));
}

/// Towards its limit and back: never further ahead than allowed, and without a leap to the last
/// good pose when that is all there is.
TEST(Prediction, IsCappedAndEndsAtTheLastGoodPose) {
    const DeviceOptions options = head_options();
    TrackedDevice device(options);
    constexpr double kSpeed = 2;
    for (int i = 0; i <= 20; ++i)
        device.add_pose(Seconds(0.01 * i), {{kSpeed * 0.01 * i, 0, 0}, {1, 0, 0, 0}});
    const double last = kSpeed * 0.2;
    double before = -1, farthest = 0;
    for (int ms = 0; ms <= 150; ++ms) {
        const DeviceState state = device.poll(Seconds(0.2 + 1e-3 * ms));
        const double ahead = state.pose->position.x - last;
        if (ms == 0) {
            EXPECT_NEAR(ahead, kSpeed * options.prediction.display_delay.count(), 1e-5);
            before = ahead;
        }
        EXPECT_GE(ahead, -1e-6);
        EXPECT_LE(std::abs(ahead - before), 0.003) << ms;
        farthest = std::max(farthest, ahead);
        before = ahead;
        if (ms != 100) {
            EXPECT_EQ(state.tracking(), ms < 100 ? Tracking::tracked : Tracking::held) << ms;
        }
        if (ms >= 100) {
            EXPECT_NEAR(ahead, 0, 1e-6);
        }
    }
    EXPECT_NEAR(farthest, kSpeed * options.prediction.limit.count(), 1e-5);
}

TEST(Prediction, AMadVelocityDoesNotThrowTheHeadAway) {
    TrackedDevice device(head_options());
    device.add_pose(Seconds(0), kStanding, Velocity{{1e9, 0, 0}, {0, 1e9, 0}});
    const DeviceState state = device.poll(Seconds(0.02));
    EXPECT_LT(glm::length(state.pose->position - kStanding.position), 0.25);
}

/// What came after the poll counts, and the picture is seen no later for it.
TEST(Latch, StatesTheNewestPoseForTheDisplayTimeOfThePoll) {
    const DeviceOptions options = head_options();
    TrackedDevice device(options);
    constexpr float kSpeed = 2;
    const auto at = [](double t) {
        return Pose{{kSpeed * static_cast<float>(t), 0, 0}, {1, 0, 0, 0}};
    };
    for (int i = 0; i <= 20; ++i)
        device.add_pose(Seconds(0.01 * i), at(0.01 * i));
    const DeviceState polled = device.poll(Seconds(0.2));
    device.add_pose(Seconds(0.208), at(0.208));
    const DeviceState latched = device.latch(Seconds(0.21));
    EXPECT_EQ(latched.measured, Seconds(0.208));
    const double seen = 0.2 + options.prediction.display_delay.count();
    EXPECT_NEAR(latched.pose->position.x, kSpeed * seen, 1e-4);
    EXPECT_NEAR(latched.pose->position.x, polled.pose->position.x, 1e-4) << "it moves steadily";
    // Long after the picture should have been seen, it is now that counts.
    EXPECT_NEAR(device.latch(Seconds(0.24)).pose->position.x, kSpeed * 0.24, 1e-4);
}

TEST(Latch, LeavesWhatWasTappedToTheNextPoll) {
    TrackedDevice device(head_options());
    device.heard(Seconds(1));
    device.set_buttons(1);
    device.set_buttons(0);
    device.set_valuator(0, 0.5f);
    const DeviceState latched = device.latch(Seconds(1));
    EXPECT_EQ(latched.buttons, 0u);
    EXPECT_TRUE(latched.valuators.empty());
    const DeviceState polled = device.poll(Seconds(1));
    EXPECT_EQ(polled.buttons, 1u);
    EXPECT_EQ(polled.valuators, std::vector<float>{0.5f});
}

/// Prediction must not make restless what stands still.
TEST(Prediction, AStandingHeadStillSettles) {
    Random random(test_seed());
    std::normal_distribution<float> jitter(0.0f, 0.0002f);
    TrackedDevice device(head_options());
    MotionGate gate{StillnessLimits{}};
    int settled = 0;
    constexpr int kFrames = 600;
    for (int frame = 0; frame < kFrames; ++frame) {
        const Seconds now(frame / 60.0);
        const auto turn = glm::angleAxis(jitter(random), glm::vec3(0, 1, 0));
        device.add_pose(now, {{jitter(random), 1.6f + jitter(random), jitter(random)}, turn});
        settled +=
            gate.update({now, {device.poll(now)}}, {}, QualityMode::automatic) == Pace::settled;
    }
    EXPECT_GT(settled, kFrames * 9 / 10);
}

TEST(TrackedDevice, ATapBetweenTwoPollsIsDownInOne) {
    TrackedDevice device(head_options());
    device.heard(Seconds(0));
    device.set_button(3, true);
    device.set_button(3, false);
    EXPECT_EQ(device.poll(Seconds(0.01)).buttons, 8u);
    EXPECT_EQ(device.poll(Seconds(0.02)).buttons, 0u);
}

TEST(TrackedDevice, NothingStaysPressedWhenTheTrackerStops) {
    TrackedDevice device(head_options());
    device.heard(Seconds(0));
    device.set_button(0, true);
    device.set_valuator(1, 0.5f);
    EXPECT_EQ(device.poll(Seconds(0.9)).buttons, 1u);
    const DeviceState state = device.poll(Seconds(1.1));
    EXPECT_EQ(state.buttons, 0u);
    EXPECT_EQ(state.valuators, (std::vector<float>{0, 0}));
}

TEST(TrackedDevice, ButtonsAndValuatorsAreChosenAndScaled) {
    DeviceOptions options = head_options();
    options.buttons = {4, 0};
    options.valuators = {1, 0, 9};
    options.valuator_factors = {1.0f, -2.0f, 1.0f};
    TrackedDevice device(options);
    device.heard(Seconds(0));
    device.set_button(0, true);
    device.set_button(1, true);
    device.set_valuator(0, 0.25f);
    device.set_valuator(1, 1.0f);
    device.set_valuator(1, NAN);
    device.set_valuator(999, 1.0f);
    device.set_button(999, true);
    const DeviceState state = device.poll(Seconds(0));
    EXPECT_EQ(state.buttons, 2u);
    EXPECT_EQ(state.valuators, (std::vector<float>{1.0f, -0.5f, 0.0f}));
}

TEST(TrackedDevice, AskingTwiceMovesNothing) {
    TrackedDevice device(head_options());
    for (int i = 0; i < 10; ++i)
        device.add_pose(Seconds(0.01 * i), looking_about(0.01 * i));
    EXPECT_EQ(device.poll(Seconds(0.1)), device.poll(Seconds(0.1)));
}

TEST(DeviceClock, TakesTheDelaysOfTheNetworkOut) {
    Random random(test_seed());
    DeviceClock clock;
    double worst = 0;
    for (int i = 0; i < 2000; ++i) {
        const double measured = i / 60.0;
        const double arrival = measured + 0.002 + (i % 7 ? uniform(random, 0, 0.02) : 0.0);
        const Seconds found = clock.session_time(Seconds(40000 + measured), Seconds(arrival));
        EXPECT_LE(found.count(), arrival + 1e-9);
        if (i > 7)
            worst = std::max(worst, std::abs(found.count() - measured - 0.002));
    }
    EXPECT_LT(worst, 1e-4);
}

TEST(DeviceClock, FollowsADriftAndStartsOverAtMidnight) {
    DeviceClock clock;
    for (int i = 0; i < 6000; ++i) {
        const double now = i / 60.0;
        const double stamp = std::fmod(86390 + now * (1 + 5e-5), 86400);
        EXPECT_NEAR(clock.session_time(Seconds(stamp), Seconds(now)).count(), now, 1e-3) << i;
    }
}

/// One stamp in the future makes all others look old, but not for long.
TEST(DeviceClock, ForgetsAWrongStamp) {
    DeviceClock clock;
    for (int i = 0; i < 300; ++i) {
        const double now = i / 60.0;
        const double wrong = i == 30 ? 0.08 : 0.0;
        const Seconds found = clock.session_time(Seconds(now + wrong), Seconds(now));
        EXPECT_LE(found.count(), now + 1e-9);
        EXPECT_NEAR(found.count(), now, i < 30 || i > 160 ? 1e-9 : 0.1) << i;
    }
}

TEST(FrameSequence, DropsWhatIsLateAndCountsWhatIsMissing) {
    FrameSequence sequence;
    Seconds now{0};
    const auto frame = [&](std::uint32_t counter) {
        now += Seconds(1.0 / 60);
        return sequence.accept(counter, now);
    };
    EXPECT_TRUE(frame(4294967294u));
    EXPECT_TRUE(frame(4294967295u));
    EXPECT_TRUE(frame(1)); // it wraps round, and 0 is missing
    EXPECT_FALSE(frame(0));
    EXPECT_FALSE(frame(1));
    EXPECT_TRUE(frame(5));
    EXPECT_EQ(sequence.missing(), 4u);
    EXPECT_EQ(sequence.late(), 2u);
    EXPECT_TRUE(frame(4000000)) << "a leap forward is a sender that has started over";
    EXPECT_TRUE(frame(6)) << "and so is a leap back";
    now += Seconds(1);
    EXPECT_TRUE(frame(2)) << "and anything after a silence";
    EXPECT_EQ(sequence.accepted(), 7u);
}

TEST(CompositeInput, ATrackersPoseGoesBeforeTheEmulatedOne) {
    DeviceState tracked = wand_at(kStanding, 1, 0.0f, 0.5f);
    DeviceState emulated = wand_at({{9, 9, 9}, {1, 0, 0, 0}}, 2, 0.25f, 1.0f);
    const DeviceState both = merged(tracked, emulated);
    EXPECT_EQ(both.pose, kStanding);
    EXPECT_EQ(both.buttons, 3u);
    EXPECT_EQ(both.valuators, (std::vector<float>{0.25f, 0.5f}));

    tracked.pose_valid = false;
    EXPECT_EQ(merged(tracked, emulated).pose, kStanding) << "a held pose is not given up";
    tracked.pose.reset();
    tracked.pose_lost = true;
    EXPECT_EQ(merged(tracked, emulated).pose, emulated.pose);
    EXPECT_EQ(merged(tracked, emulated).tracking(), Tracking::lost);

    const DeviceState buttons{"wand", std::nullopt, true, 4, {}};
    EXPECT_EQ(merged(buttons, emulated).pose, emulated.pose);
    EXPECT_EQ(merged(buttons, emulated).tracking(), Tracking::tracked) << "buttons lose no pose";
}

} // namespace
} // namespace isochron::interaction
