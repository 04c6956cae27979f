// The motion gate with synthetic heads: sway, tracker noise, starts, stops and random input.
#include "interaction/controls/motion_gate.h"

#include "tests/interaction/input_builders.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace isochron::interaction {
namespace {

constexpr double kRates[] = {60, 90, 120};

/// What a tracker adds to each sample: 0.1 mm and 0.02 degrees rms.
class TrackerNoise {
  public:
    explicit TrackerNoise(Random& random) : random_(random) {}
    Pose on(const Pose& pose) {
        const auto axis = [&] {
            return glm::vec3(normal_(random_), normal_(random_), normal_(random_)) /
                   std::sqrt(3.0f);
        };
        const glm::vec3 turn = glm::radians(0.02f) * axis();
        return {pose.position + 1e-4f * axis(),
                glm::normalize(glm::quat(1.0f, turn / 2.0f) * pose.orientation)};
    }

  private:
    Random& random_;
    std::normal_distribution<float> normal_;
};

/// Standing sway: per axis five sinusoids of 0.1 to 0.5 Hz, rms 4 mm sideways and forward, and 0.4
/// degrees.
class Sway {
  public:
    explicit Sway(Random& random) {
        for (auto& axis : axes_)
            for (auto& wave : axis)
                wave = {uniform(random, 0.1, 0.5), uniform(random, 0, 6.2832)};
    }
    Pose at(double t) const {
        const glm::dvec3 shift(along(0, t), 0.2 * along(1, t), along(2, t));
        const glm::dvec3 turn(along(3, t), along(4, t), along(5, t));
        const glm::dvec3 position = glm::dvec3(kStanding.position) + 0.004 * shift;
        const glm::dvec3 half = glm::radians(0.4) / 2 * turn;
        return {glm::vec3(position), glm::quat(glm::normalize(glm::dquat(1.0, half)))};
    }

  private:
    struct Wave {
        double frequency, phase;
    };
    double along(int axis, double t) const { // rms 1
        double sum = 0;
        for (const Wave& wave : axes_[axis])
            sum += std::sin(6.283185307 * wave.frequency * t + wave.phase);
        return sum * std::sqrt(2.0 / 5.0);
    }
    Wave axes_[6][5];
};

struct Watch {
    int frames = 0, settled = 0, transitions = 0;
};

Watch watch(MotionGate& gate, double rate, double seconds,
            const std::function<Pose(double)>& head) {
    Watch result;
    Pace last = gate.pace();
    for (int frame = 0; frame < rate * seconds; ++frame) {
        const Seconds now(frame / rate);
        const Pace pace =
            gate.update({now, {head_at(head(now.count()))}}, {}, QualityMode::automatic);
        ++result.frames;
        result.settled += pace == Pace::settled;
        result.transitions += pace != last;
        last = pace;
    }
    return result;
}

TEST(MotionGate, StandingSwayIsSettledAtLeastEightyPercentOfTheTime) {
    for (const double rate : kRates)
        for (unsigned seed = 0; seed < 8; ++seed) {
            SCOPED_TRACE(testing::Message() << "seed " << seed << " at " << rate << " Hz");
            Random random(seed);
            const Sway sway(random);
            TrackerNoise noise(random);
            MotionGate gate{StillnessLimits{}};
            const Watch result =
                watch(gate, rate, 60, [&](double t) { return noise.on(sway.at(t)); });
            EXPECT_GE(result.settled, 0.8 * result.frames);
            EXPECT_LE(result.transitions, 6);
        }
}

TEST(MotionGate, TrackerNoiseAloneSettlesOnceAndStaysSettled) {
    for (const double rate : kRates)
        for (unsigned seed = 0; seed < 8; ++seed) {
            SCOPED_TRACE(testing::Message() << "seed " << seed << " at " << rate << " Hz");
            Random random(seed);
            TrackerNoise noise(random);
            MotionGate gate{StillnessLimits{}};
            EXPECT_EQ(
                watch(gate, rate, 60, [&](double) { return noise.on(kStanding); }).transitions, 1);
        }
}

TEST(MotionGate, StillnessSettlesAfterTheDelayAndNotBefore) {
    for (const double rate : kRates) {
        MotionGate gate{StillnessLimits{}};
        for (int frame = 0; frame < rate; ++frame) {
            const Seconds now(frame / rate);
            const Pace pace = gate.update({now, {head_at(kStanding)}}, {}, QualityMode::automatic);
            EXPECT_EQ(pace, now.count() < 0.150 - 1e-9 ? Pace::moving : Pace::settled)
                << now.count();
        }
    }
}

/// A head that starts moving at `start`, steadily.
Pose moving_head(double t, double start, double linear, double angular) {
    const auto since = static_cast<float>(std::max(t - start, 0.0));
    return {kStanding.position + glm::vec3(static_cast<float>(linear) * since, 0, 0),
            glm::angleAxis(static_cast<float>(angular) * since, glm::vec3(0, 1, 0))};
}

TEST(MotionGate, ClearMotionIsNoticedWithinTwoFrames) {
    for (const double rate : kRates)
        for (unsigned seed = 0; seed < 20; ++seed)
            for (const bool turning : {false, true}) {
                SCOPED_TRACE(testing::Message() << "seed " << seed << " at " << rate << " Hz");
                Random random(seed);
                TrackerNoise noise(random);
                MotionGate gate{StillnessLimits{}};
                const double speed = turning ? 0.0 : 0.15, turn = turning ? 0.375 : 0.0;
                const double start = 1.0;
                const auto head = [&](double t) {
                    return noise.on(moving_head(t, start, speed, turn));
                };
                const int first = static_cast<int>(start * rate) + 1; // frame that shows motion
                for (int frame = 0; frame <= first + 1; ++frame) {
                    const Seconds now(frame / rate);
                    const Pace pace = gate.update({now, {head_at(head(now.count()))}}, {},
                                                  QualityMode::automatic);
                    if (frame == first - 1) {
                        ASSERT_EQ(pace, Pace::settled);
                    }
                    if (frame == first + 1) {
                        EXPECT_EQ(pace, Pace::moving);
                    }
                }
            }
}

TEST(MotionGate, BetweenTheTwoLimitsThePaceStaysAsItWas) {
    for (const double rate : kRates) {
        for (const double factor : {1.3, 2.0, 2.7}) {
            MotionGate moving{StillnessLimits{}}, settled{StillnessLimits{}};
            const auto always = [&](double t) { return moving_head(t, -1, factor * 0.02, 0); };
            const auto later = [&](double t) { return moving_head(t, 1, factor * 0.02, 0); };
            EXPECT_EQ(watch(moving, rate, 5, always).settled, 0) << factor;
            EXPECT_EQ(watch(settled, rate, 5, later).transitions, 1) << factor;
        }
    }
}

TEST(MotionGate, EveryPendingInputLeavesSettledAtOnce) {
    Commands isovalue, surfaces, step, volume, play;
    isovalue.isovalue = 1.0;
    surfaces.isosurfaces = std::vector<Isosurface>(2);
    step.instant = Instant(3);
    volume.room_from_physical = Similarity{};
    play.playback = PlaybackState{};
    const std::vector<std::pair<std::vector<DeviceState>, Commands>> inputs{
        {{head_at(kStanding)}, isovalue},
        {{head_at(kStanding)}, surfaces},
        {{head_at(kStanding)}, step},
        {{head_at(kStanding)}, volume},
        {{head_at(kStanding)}, play},
        {{head_at(kStanding), keys_down(bit(Action::grab))}, {}},
        {{head_at(kStanding), wand_at(kStanding, bit(WandButton::fly))}, {}},
        {{head_at(kStanding), wand_at(kStanding, 0, 0.5f)}, {}},
        {{head_at(kStanding), mouse_dragged({0.001f})}, {}},
    };
    for (const auto& [devices, commands] : inputs) {
        MotionGate gate{StillnessLimits{}};
        watch(gate, 60, 1, [](double) { return kStanding; });
        ASSERT_EQ(gate.pace(), Pace::settled);
        EXPECT_EQ(gate.update({Seconds(1), devices}, commands, QualityMode::automatic),
                  Pace::moving);
    }
}

TEST(MotionGate, KeysThatLeaveThePictureAloneKeepItSettled) {
    Commands screenshot;
    screenshot.screenshot = true;
    screenshot.stamps = {"stamp-1"};
    MotionGate gate{StillnessLimits{}};
    watch(gate, 60, 1, [](double) { return kStanding; });
    const InputState input{Seconds(1), {head_at(kStanding), keys_down(quiet_actions())}};
    EXPECT_EQ(gate.update(input, screenshot, QualityMode::automatic), Pace::settled);
}

TEST(MotionGate, AnIdleWandMayMove) {
    MotionGate gate{StillnessLimits{}};
    int settled = 0;
    for (int frame = 0; frame < 60; ++frame) {
        const Seconds now(frame / 60.0);
        settled +=
            gate.update({now, {head_at(kStanding), wand_at(moving_head(now.count(), 0, 1, 1))}}, {},
                        QualityMode::automatic) == Pace::settled;
    }
    EXPECT_GE(settled, 50);
}

TEST(MotionGate, TimeThatPlaysIsMotionUntilItStops) {
    MotionGate gate{StillnessLimits{}};
    Commands play, stop;
    play.playback = PlaybackState{true, false, true, 1.0};
    stop.playback = PlaybackState{};
    for (int frame = 0; frame < 300; ++frame) {
        const Seconds now(frame / 60.0);
        const Pace pace = gate.update({now, {head_at(kStanding)}},
                                      frame == 0     ? play
                                      : frame == 200 ? stop
                                                     : Commands{},
                                      QualityMode::automatic);
        if (frame <= 200) {
            EXPECT_EQ(pace, Pace::moving) << frame;
        }
        if (frame > 210) {
            EXPECT_EQ(pace, Pace::settled) << frame;
        }
    }
}

TEST(MotionGate, ALostHeadCountsAsStillWhereverItReappears) {
    MotionGate gate{StillnessLimits{}};
    for (int frame = 0; frame < 120; ++frame) {
        DeviceState head = head_at(kStanding);
        head.pose_valid = frame < 30 || frame >= 60;
        if (frame >= 60)
            head.pose->position.x = 1.0f;
        const Pace pace = gate.update({Seconds(frame / 60.0), {head}}, {}, QualityMode::automatic);
        if (frame >= 15) {
            EXPECT_EQ(pace, Pace::settled) << frame;
        }
    }
}

TEST(MotionGate, AStepThatStandsForLongSettlesWhileTimePlays) {
    Commands play, next;
    play.playback = PlaybackState{true, false, true, 1.0};
    next.instant = Instant(1);
    for (const int frames_of_step : {6, 8, 60}) { // 0.1 s, 0.13 s, 1 s
        SCOPED_TRACE(frames_of_step);
        MotionGate by_steps{StillnessLimits{}}, always{StillnessLimits{}};
        int settled = 0;
        for (int frame = 0; frame < 180; ++frame) {
            const InputState input{Seconds(frame / 60.0), {}};
            const Commands commands = frame == 0                    ? play
                                      : frame % frames_of_step == 0 ? next
                                                                    : Commands{};
            EXPECT_EQ(always.update(input, commands, QualityMode::automatic), Pace::moving);
            const Pace pace =
                by_steps.update(input, commands, QualityMode::automatic, Playing::moves_by_steps);
            if (!(commands == Commands{})) {
                EXPECT_EQ(pace, Pace::moving) << "a new step";
            }
            settled += pace == Pace::settled;
        }
        EXPECT_EQ(settled > 0, frames_of_step > 6) << "from 0.1 s after the step on";
        EXPECT_LE(settled, 180 - 6 * 180 / frames_of_step);
    }
}

TEST(MotionGate, FastAndQualityModesOverrule) {
    MotionGate gate{StillnessLimits{}};
    for (int frame = 0; frame < 60; ++frame) {
        const Seconds now(frame / 60.0);
        const InputState input{now, {head_at(moving_head(now.count(), 0.5, 1, 0))}};
        EXPECT_EQ(gate.update(input, {}, QualityMode::fast), Pace::moving);
        EXPECT_EQ(gate.update(input, {}, QualityMode::quality), Pace::settled);
        EXPECT_EQ(gate.pace(), Pace::settled);
    }
}

/// Anything at all: valid and invalid poses, buttons, valuators, commands, odd clocks.
InputState random_input(Random& random, Seconds now) {
    InputState input{now, {}};
    const auto chance = [&](double p) { return uniform(random, 0, 1) < p; };
    if (chance(0.9)) {
        DeviceState head =
            head_at({{float(uniform(random, -1, 1)), float(uniform(random, 0, 2)), 0},
                     random_rotation(random)});
        head.pose_valid = chance(0.8);
        if (chance(0.05))
            head.pose->position.y = std::nanf("");
        input.devices.push_back(head);
    }
    input.devices.push_back(wand_at({{0, 1, 0}, random_rotation(random)},
                                    chance(0.3) ? random() : 0, chance(0.2) ? 0.5f : 0.0f));
    input.devices.push_back(keys_down(chance(0.3) ? random() : 0));
    return input;
}

TEST(MotionGate, CannotStickWhateverCameBefore) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Random random(seed);
        MotionGate gate{StillnessLimits{}};
        double now = 0;
        for (int frame = 0; frame < 200; ++frame) {
            Commands commands;
            if (uniform(random, 0, 1) < 0.1)
                commands.isovalue = uniform(random, 0, 1);
            if (uniform(random, 0, 1) < 0.1)
                commands.playback = PlaybackState{random() % 2 == 0, false, true, 1.0};
            const auto mode = static_cast<QualityMode>(random() % 3);
            gate.update(random_input(random, Seconds(now)), commands, mode);
            now += uniform(random, 0, 1) < 0.1 ? 0.0 : uniform(random, 0.001, 0.2);
        }
        Commands stop;
        stop.playback = PlaybackState{};
        const double rate = uniform(random, 10, 240);
        for (int frame = 0; frame <= rate; ++frame) {
            gate.update({Seconds(now + frame / rate), {head_at(kStanding)}},
                        frame == 0 ? stop : Commands{}, QualityMode::automatic);
        }
        EXPECT_EQ(gate.pace(), Pace::settled);
    }
}

} // namespace
} // namespace isochron::interaction
