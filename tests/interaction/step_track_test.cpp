// The steps that playing goes through: ranges, steps left out, ways to and fro, speeds, bookmarks.
#include "interaction/step_track.h"

#include "interaction/playback.h"
#include "tests/interaction/input_builders.h"
#include "tests/support/test_seed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace isochron::interaction {
namespace {

using Steps = std::vector<std::uint32_t>;

const std::vector<double> kTen{0, 1, 2, 3, 4, 5, 6, 7, 8, 9};

/// The steps that playing shows, one after the other, each once in a row.
Steps shown(PlaybackState state, const StepRange& range, std::uint32_t from, std::size_t most,
            const std::vector<double>& times = kTen) {
    Playback playback;
    state.playing = true;
    Steps steps{from};
    for (int frame = 0; frame < 100'000 && steps.size() < most && state.playing; ++frame) {
        const Playback::Result now =
            playback.advance(times, Instant(steps.back()), state, Seconds(0.01), range);
        state.playing = now.playing;
        state.reverse = now.reverse;
        if (now.instant.step != steps.back())
            steps.push_back(now.instant.step);
    }
    return steps;
}

TEST(StepTrack, PlayingKeepsToItsRange) {
    EXPECT_EQ(shown({}, {3, 5}, 3, 7), (Steps{3, 4, 5, 3, 4, 5, 3}));
    EXPECT_EQ(shown({.loop = false}, {3, 5}, 3, 7), (Steps{3, 4, 5}));
    EXPECT_EQ(shown({.reverse = true}, {3, 5}, 4, 5), (Steps{4, 3, 5, 4, 3}));
    EXPECT_EQ(shown({}, {3, 5}, 8, 3), (Steps{8, 3, 4})) << "from outside it begins at its start";
    EXPECT_EQ(shown({.reverse = true}, {3, 5}, 8, 3), (Steps{8, 5, 4}));
    EXPECT_EQ(shown({}, {7, {}}, 7, 4), (Steps{7, 8, 9, 7}));
    EXPECT_EQ(shown({}, {{}, 1}, 0, 3), (Steps{0, 1, 0}));
}

TEST(StepTrack, StepsAreLeftOut) {
    EXPECT_EQ(shown({.every = 3}, {}, 0, 6), (Steps{0, 3, 6, 9, 0, 3}));
    EXPECT_EQ(shown({.every = 4}, {1, 8}, 1, 4), (Steps{1, 5, 1, 5}));
    EXPECT_EQ(shown({.reverse = true, .every = 4}, {}, 8, 4), (Steps{8, 4, 0, 8}));
    EXPECT_EQ(shown({.every = 3}, {}, 4, 3), (Steps{4, 6, 9})) << "goes on at the next one";
}

TEST(StepTrack, ToAndFroShowsTheEndsOnce) {
    EXPECT_EQ(shown({.ping_pong = true}, {}, 7, 8), (Steps{7, 8, 9, 8, 7, 6, 5, 4}));
    EXPECT_EQ(shown({.loop = false, .ping_pong = true}, {2, 4}, 2, 9),
              (Steps{2, 3, 4, 3, 2, 3, 4, 3, 2}));
    EXPECT_EQ(shown({.ping_pong = true, .every = 4}, {}, 0, 6), (Steps{0, 4, 8, 4, 0, 4}));
    EXPECT_EQ(shown({.reverse = true, .ping_pong = true}, {}, 1, 4), (Steps{1, 0, 1, 2}));
    EXPECT_EQ(shown({.ping_pong = true}, {4, 5}, 4, 4), (Steps{4, 5, 4, 5}));
}

TEST(StepTrack, ToAndFroEachStepLastsAsLongAsItDoesInTheData) {
    Random random(test_seed());
    for (int trial = 0; trial < tries(20); ++trial) {
        SCOPED_TRACE(testing::Message() << "trial " << trial);
        std::vector<double> times{uniform(random, -9, 9)};
        for (std::size_t size = 3 + random() % 20; times.size() < size;)
            times.push_back(times.back() + std::exp(uniform(random, -2, 2)));
        PlaybackState state{.playing = true, .ping_pong = true};
        const StepTrack track(times, {}, state);
        const double round = track.duration() + track.start(track.last()) - track.start(1);
        constexpr int kFrames = 100'000; // frames of one way up and down
        const Seconds apart(round / (kFrames * track_rate(state, times)));
        Playback playback;
        std::vector<int> frames(times.size(), 0);
        std::uint32_t step = 0;
        for (int i = 0; i < kFrames; ++i) {
            const Playback::Result now = playback.advance(times, Instant(step), state, apart);
            step = now.instant.step;
            state.reverse = now.reverse;
            ++frames[step];
        }
        for (std::uint32_t i = 0; i < times.size(); ++i) {
            const double ways = i == 0 || i == track.last() ? 1 : 2;
            EXPECT_NEAR(frames[i], ways * kFrames * (track.start(i + 1) - track.start(i)) / round,
                        6)
                << "step " << i;
        }
    }
}

TEST(StepTrack, SpeedsCountStepsOrTheTimeOfTheData) {
    const std::vector<double> uneven{0, 1, 2, 12};
    const auto frames_of = [&](const PlaybackState& state) {
        Playback playback;
        std::vector<int> frames(uneven.size(), 0);
        for (std::uint32_t step = 0, frame = 0; frame < 1000; ++frame) {
            step = playback.advance(uneven, Instant(step), state, Seconds(0.01)).instant.step;
            ++frames[step];
        }
        return frames;
    };
    // One second for each step: 10 s are two rounds and a half.
    const auto evenly = frames_of({.playing = true, .unit = SpeedUnit::steps, .rate = 1});
    for (const std::size_t step : {0u, 1u})
        EXPECT_NEAR(evenly[step], 300, 3);
    for (const std::size_t step : {2u, 3u})
        EXPECT_NEAR(evenly[step], 200, 3);
    // Two units of time a second: the first 20 of a round of 16.
    const auto physical = frames_of({.playing = true, .unit = SpeedUnit::time, .rate = 2});
    EXPECT_NEAR(physical[0], 100, 3);
    EXPECT_NEAR(physical[2], 600, 3);
    EXPECT_NEAR(physical[3], 200, 3);
}

TEST(StepTrack, ARateThatRunsThroughAllRoundsAtOnceStaysInTheSeries) {
    for (const SpeedUnit unit : {SpeedUnit::steps, SpeedUnit::time})
        for (const bool ping_pong : {false, true})
            for (const double rate : {kFastestRate, kSlowestRate}) {
                Playback playback;
                PlaybackState state{
                    .playing = true, .ping_pong = ping_pong, .unit = unit, .rate = rate};
                std::uint32_t step = 4;
                for (int frame = 0; frame < 100; ++frame) {
                    const auto now =
                        playback.advance(kTen, Instant(step), state, Seconds(0.016), {2, 6});
                    step = now.instant.step;
                    state.reverse = now.reverse;
                    ASSERT_GE(step, 2u);
                    ASSERT_LE(step, 6u);
                }
            }
}

TEST(StepTrack, AnotherUnitKeepsThePace) {
    const std::vector<double> times{0, 2, 4, 6, 8};
    PlaybackState state{.speed = 4};
    state = counted_in(SpeedUnit::steps, state, times);
    EXPECT_EQ(state.unit, SpeedUnit::steps);
    EXPECT_NEAR(state.rate, 2, 1e-9); // 5 steps in 2.5 s
    state = sped_up(state, 2);
    EXPECT_NEAR(state.rate, 4, 1e-9);
    EXPECT_EQ(state.speed, 4);
    state = counted_in(SpeedUnit::time, state, times);
    EXPECT_NEAR(state.rate, 8, 1e-9);
    state = counted_in(SpeedUnit::series, state, times);
    EXPECT_NEAR(state.speed, 8, 1e-9);
    state.every = 5;
    EXPECT_NEAR(counted_in(SpeedUnit::steps, state, times).rate, 0.8, 1e-9) << "pictures a second";
    EXPECT_EQ(counted_in(SpeedUnit::steps, {}, std::vector<double>{3}), PlaybackState{});
}

TEST(StepTrack, StepKeysLeaveOutStepsAndWrapWithLoop) {
    const PlaybackState loops{.every = 4}, stops{.loop = false, .every = 4};
    EXPECT_EQ(next_step(3, loops, 10), 7u);
    EXPECT_EQ(next_step(7, loops, 10), 0u);
    EXPECT_EQ(next_step(7, stops, 10), 9u);
    EXPECT_EQ(previous_step(Instant(7), loops, 10), 3u);
    EXPECT_EQ(previous_step(Instant(3), stops, 10), 0u);
    EXPECT_EQ(previous_step(Instant(0), loops, 10), 8u);
    EXPECT_EQ(next_step(9, {}, 10), 0u);
    EXPECT_EQ(previous_step(Instant(0), {}, 10), 9u);
    EXPECT_EQ(next_step(0, loops, 1), 0u);
    EXPECT_EQ(previous_step(Instant(0), stops, 1), 0u);
    EXPECT_EQ(previous_step({7, 1}, loops, 10), 7u) << "between two steps";
    EXPECT_EQ(previous_step({9, 1}, {}, 10), 8u) << "the last step holds";
}

TEST(StepTrack, EndsOfARangeGiveWayToEachOther) {
    EXPECT_EQ(begun_at(4, {}), (StepRange{4, {}}));
    EXPECT_EQ(begun_at(4, {4, 9}), (StepRange{{}, 9}));
    EXPECT_EQ(begun_at(4, {1, 3}), (StepRange{4, {}}));
    EXPECT_EQ(ended_at(4, {1, 9}), (StepRange{1, 4}));
    EXPECT_EQ(ended_at(4, {1, 4}), (StepRange{1, {}}));
    EXPECT_EQ(ended_at(4, {5, 9}), (StepRange{{}, 4}));
    EXPECT_EQ(marked_at(4, {}), (StepRange{4, {}}));
    EXPECT_EQ(marked_at(7, {4, {}}), (StepRange{4, 7}));
    EXPECT_EQ(marked_at(2, {4, {}}), (StepRange{2, {}}));
    EXPECT_EQ(marked_at(4, {4, {}}), StepRange{});
    EXPECT_EQ(marked_at(5, {4, 7}), StepRange{});
}

TEST(StepTrack, BookmarksAreVisitedInOrderAndAround) {
    const std::vector<Bookmark> marks{{"late", Instant(7)}, {"early", Instant(2)}};
    EXPECT_EQ(next_bookmark(marks, Instant(0)), Instant(2));
    EXPECT_EQ(next_bookmark(marks, Instant(2)), Instant(7));
    EXPECT_EQ(next_bookmark(marks, Instant(8)), Instant(2));
    EXPECT_EQ(previous_bookmark(marks, Instant(8)), Instant(7));
    EXPECT_EQ(previous_bookmark(marks, Instant(7)), Instant(2));
    EXPECT_EQ(previous_bookmark(marks, Instant(1)), Instant(7));
    EXPECT_EQ(next_bookmark({}, Instant(1)), std::nullopt);
    EXPECT_EQ(previous_bookmark({}, Instant(1)), std::nullopt);
}

TEST(StepTrack, BookmarksBetweenStepsHaveTheirMoment) {
    const std::vector<Bookmark> marks =
        toggled_bookmark(toggled_bookmark({}, Instant(3)), Instant(3, Instant::kFractions / 2));
    ASSERT_EQ(marks.size(), 2u);
    EXPECT_EQ(marks[1].name, "step 4.50");
    EXPECT_EQ(next_bookmark(marks, Instant(3)), Instant(3, Instant::kFractions / 2));
    EXPECT_EQ(next_bookmark(marks, Instant(3, Instant::kFractions / 2)), Instant(3)) << "around";
    EXPECT_EQ(previous_bookmark(marks, Instant(3, 7)), Instant(3));
    EXPECT_EQ(toggled_bookmark(marks, Instant(3, Instant::kFractions / 2)).size(), 1u)
        << "it goes again";
    EXPECT_EQ(next_bookmark({{{"a", {3, 9}}, {"b", Instant(5)}}}, Instant(3), false), Instant(5))
        << "where steps are held, all of step 3 is the same";
}

} // namespace
} // namespace isochron::interaction
