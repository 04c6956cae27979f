// Playback in physical time, compared with a slow walk along the time axis.
#include "interaction/playback.h"

#include "tests/interaction/input_builders.h"
#include "tests/support/test_seed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace isochron::interaction {
namespace {

std::vector<double> uneven_times(Random& random, std::size_t steps) {
    std::vector<double> times{uniform(random, -100, 100)};
    while (times.size() < steps)
        times.push_back(times.back() + std::exp(uniform(random, -3, 3)));
    return times;
}

const StepGaps kNoGaps;

PlaybackState playing(bool reverse = false, bool loop = true, double speed = 1.0) {
    return {true, reverse, loop, speed};
}

TEST(Playback, StepsAreShownForTheirShareOfPhysicalTime) {
    Random random(test_seed());
    for (int trial = 0; trial < tries(20); ++trial) {
        SCOPED_TRACE(testing::Message() << "trial " << trial);
        const std::vector<double> times = uneven_times(random, 2 + random() % 20);
        const double mean = (times.back() - times.front()) / double(times.size() - 1);
        const double round = times.back() - times.front() + mean;
        for (const bool reverse : {false, true}) {
            Playback playback;
            std::vector<int> frames(times.size(), 0);
            std::uint32_t step = reverse ? std::uint32_t(times.size() - 1) : 0;
            constexpr int kFrames = 100'000; // one round of 10 s
            for (int i = 0; i < kFrames; ++i) {
                step = playback
                           .advance(times, Instant(step), playing(reverse), Seconds(10.0 / kFrames))
                           .instant.step;
                ++frames[step];
            }
            for (std::size_t i = 0; i < times.size(); ++i) {
                const double lasts = i + 1 < times.size() ? times[i + 1] - times[i] : mean;
                EXPECT_NEAR(frames[i], kFrames * lasts / round, 3) << "step " << i;
            }
        }
    }
}

TEST(Playback, TheStepIsTheLastOneNotLaterThanTheCursor) {
    Random random(test_seed());
    for (int trial = 0; trial < tries(50); ++trial) {
        SCOPED_TRACE(testing::Message() << "trial " << trial);
        const std::vector<double> times = uneven_times(random, 40);
        const double round = period(times);
        const double speed = std::exp2(uniform(random, -6, 6));
        Playback playback;
        std::uint32_t step = 0;
        double cursor = times.front();
        for (int frame = 0; frame < 500; ++frame) {
            const double elapsed = uniform(random, 0, 0.1);
            cursor += elapsed * speed * round / 10;
            while (cursor >= times.front() + round)
                cursor -= round;
            std::uint32_t expected = 0;
            for (std::uint32_t i = 0; i < times.size(); ++i)
                if (times[i] <= cursor + 1e-9)
                    expected = i;
            step = playback
                       .advance(times, Instant(step), playing(false, true, speed), Seconds(elapsed))
                       .instant.step;
            const double margin = std::abs(times[expected] - cursor);
            if (margin > 1e-6) {
                ASSERT_EQ(step, expected) << "frame " << frame;
            }
        }
    }
}

TEST(Playback, SpeedScalesTheDurationOfARound) {
    const std::vector<double> times{0, 1, 2, 3};
    for (const double speed : {1.0 / 64, 0.5, 2.0, 64.0}) {
        Playback playback;
        std::uint32_t step = 0;
        double shown = 0; // until step 1 begins: a quarter of the round
        while (step == 0) {
            step =
                playback.advance(times, Instant(step), playing(false, true, speed), Seconds(1e-3))
                    .instant.step;
            shown += 1e-3;
        }
        EXPECT_NEAR(shown, 2.5 / speed, 2e-3);
    }
}

TEST(Playback, WithoutLoopItStopsAtTheEndAndStartsOver) {
    const std::vector<double> times{0, 1, 5, 6};
    for (const bool reverse : {false, true}) {
        const std::uint32_t first = reverse ? 3 : 0, last = reverse ? 0 : 3;
        Playback playback;
        Playback::Result now{Instant(first), true};
        for (int frame = 0; frame < 1000 && now.playing; ++frame)
            now = playback.advance(times, now.instant, playing(reverse, false), Seconds(0.05));
        EXPECT_FALSE(now.playing);
        EXPECT_EQ(now.instant.step, last);
        PlaybackState paused{false, reverse, false, 1.0};
        EXPECT_EQ(playback.advance(times, Instant(last), paused, Seconds(0.05)).instant.step, last);
        now = playback.advance(times, Instant(last), playing(reverse, false), Seconds(0.001));
        EXPECT_TRUE(now.playing);
        EXPECT_EQ(now.instant.step, first);
    }
}

TEST(Playback, FollowsAStepThatWasChosenElsewhere) {
    const std::vector<double> times{10, 20, 30, 40, 50};
    Playback playback;
    playback.advance(times, Instant(0), playing(), Seconds(0.5));
    EXPECT_EQ(playback.advance(times, Instant(3), playing(), Seconds(1.9)).instant.step, 3u);
    EXPECT_EQ(playback.advance(times, Instant(3), playing(), Seconds(0.2)).instant.step, 4u);
}

TEST(Playback, PausedTimeStandsStill) {
    const std::vector<double> times{0, 1, 2};
    Playback playback;
    for (int frame = 0; frame < 100; ++frame) {
        const Playback::Result now =
            playback.advance(times, Instant(1), PlaybackState{}, Seconds(1));
        EXPECT_EQ(now.instant.step, 1u);
        EXPECT_FALSE(now.playing);
    }
}

TEST(Playback, ASeriesOfOneStepNeverPlays) {
    const std::vector<double> times{5};
    Playback playback;
    const Playback::Result now = playback.advance(times, Instant(0), playing(), Seconds(1));
    EXPECT_EQ(now.instant.step, 0u);
    EXPECT_FALSE(now.playing);
    EXPECT_EQ(period(times), 0.0);
    EXPECT_FALSE(playback.advance({}, Instant(0), playing(), Seconds(1)).playing);
}

TEST(Playback, TurningRoundWhilePlayingKeepsThePlaceInTime) {
    const std::vector<double> times{0, 1, 2, 3};
    Playback playback;
    std::uint32_t step =
        playback.advance(times, Instant(1), playing(), Seconds(2.0)).instant.step; // 0.8 into it
    ASSERT_EQ(step, 1u);
    step = playback.advance(times, Instant(step), playing(true), Seconds(1.9)).instant.step;
    EXPECT_EQ(step, 1u);
    step = playback.advance(times, Instant(step), playing(true), Seconds(0.2)).instant.step;
    EXPECT_EQ(step, 0u);
}

TEST(Playback, UnevenAndAwkwardTimesNeverStick) {
    for (const std::vector<double>& times : {std::vector<double>{-1, 1e-20, 2e-20, 1},
                                             std::vector<double>{1.7e9, 1.7e9 + 0.25, 1.7e9 + 1},
                                             std::vector<double>{0.1, 0.2, 0.30000000000000004}}) {
        for (const bool reverse : {false, true}) {
            Playback playback;
            std::uint32_t step = 0;
            std::set<std::uint32_t> seen;
            for (int frame = 0; frame < 1200; ++frame) {
                step = playback.advance(times, Instant(step), playing(reverse), Seconds(1.0 / 60))
                           .instant.step;
                seen.insert(step);
            }
            EXPECT_TRUE(seen.contains(0));
            EXPECT_TRUE(seen.contains(std::uint32_t(times.size() - 1)));
        }
    }
}

TEST(Playback, BlendedTimePassesThroughTheMomentsBetweenTheSteps) {
    Random random(test_seed());
    for (int trial = 0; trial < tries(20); ++trial) {
        SCOPED_TRACE(testing::Message() << "trial " << trial);
        std::vector<double> times{0};
        for (std::size_t size = 3 + random() % 20; times.size() < size;)
            times.push_back(times.back() + uniform(random, 1, 2.9)); // no gaps
        for (const bool reverse : {false, true}) {
            Playback playback;
            Instant at =
                reverse ? Instant(static_cast<std::uint32_t>(times.size() - 1)) : Instant();
            double before = times[at.step];
            const double per_frame = period(times) / 1000;
            for (int i = 0; i < 2500; ++i) { // more than two rounds
                const auto now =
                    playback.advance(times, at, playing(reverse), Seconds(0.01), {}, &kNoGaps);
                at = now.instant;
                const double shown = at.fraction == 0
                                         ? times[at.step]
                                         : std::lerp(times[at.step], times[at.step + 1],
                                                     at.fraction / double(Instant::kFractions));
                const double moved = (shown - before) * (reverse ? -1 : 1);
                const bool held = shown == times.back() || before == times.back();
                if (!held) { // else it stands for the last step, or goes around
                    EXPECT_NEAR(moved, per_frame, 1e-4) << "frame " << i;
                }
                before = shown;
            }
        }
    }
}

TEST(Playback, GapsAreHeldAndSoAreStepsThatAreLeftOut) {
    const std::vector<double> times{0, 1, 2, 3, 13, 14, 15}; // ten where one is usual
    const StepGaps gaps({3, 4});
    Playback playback;
    Instant at;
    std::set<std::uint32_t> blended_in;
    for (int i = 0; i < 1000; ++i) {
        const auto now = playback.advance(times, at, playing(), Seconds(0.01), {}, &gaps);
        at = now.instant;
        if (at.fraction != 0)
            blended_in.insert(at.step);
    }
    EXPECT_EQ(blended_in, (std::set<std::uint32_t>{0, 1, 2, 5}));
    PlaybackState every_second = playing();
    every_second.every = 2;
    for (int i = 0; i < 1000; ++i)
        EXPECT_FALSE(playback.advance(times, Instant(0), every_second, Seconds(0.01), {}, &gaps)
                         .instant.between());
}

TEST(Playback, BlendedTimeGoesOnFromAMomentThatWasChosenElsewhere) {
    const std::vector<double> times{0, 1, 2, 3};
    Playback playback;
    const Instant chosen(1, Instant::kFractions / 4);
    const auto rests = playback.advance(times, chosen, {}, Seconds(1), {}, &kNoGaps);
    EXPECT_EQ(rests.instant, chosen);
    const auto now = playback.advance(times, chosen, playing(), Seconds(0.5), {}, &kNoGaps);
    EXPECT_EQ(now.instant, Instant(1, Instant::kFractions / 4 + Instant::kFractions / 5));
}

TEST(Playback, WithoutLoopBlendedTimeEndsAtTheEndsThemselves) {
    const std::vector<double> times{0, 1, 2, 3};
    for (const bool reverse : {false, true}) {
        Playback playback;
        Instant at = reverse ? Instant(3) : Instant(0);
        bool plays = true;
        for (int i = 0; i < 2000 && plays; ++i) {
            const auto now =
                playback.advance(times, at, playing(reverse, false), Seconds(0.01), {}, &kNoGaps);
            at = now.instant;
            plays = now.playing;
        }
        EXPECT_FALSE(plays);
        EXPECT_EQ(at, reverse ? Instant(0) : Instant(3));
    }
}

} // namespace
} // namespace isochron::interaction
