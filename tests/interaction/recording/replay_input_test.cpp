// A recording as input: at any time it gives the newest frame that is not later.
#include "interaction/recording/recording.h"
#include "tests/interaction/input_builders.h"

#include <gtest/gtest.h>

namespace isochron::interaction {
namespace {

TEST(ReplayInput, GivesTheNewestFrameNotLaterThanNow) {
    Recording recording;
    for (const double time : {1.0, 1.1, 1.1, 1.5})
        recording.frames.push_back(
            {{Seconds(time), {head_at({{float(recording.frames.size()), 0, 0}, {1, 0, 0, 0}})}},
             {},
             {}});
    ReplayInput replay(recording);
    EXPECT_EQ(replay.poll(Seconds(0)), recording.frames[0].input);
    EXPECT_EQ(replay.frames_played(), 1u);
    EXPECT_EQ(replay.poll(Seconds(1.09)), recording.frames[0].input);
    EXPECT_EQ(replay.poll(Seconds(1.1)), recording.frames[2].input);
    EXPECT_EQ(replay.frames_played(), 3u);
    EXPECT_FALSE(replay.finished());
    EXPECT_EQ(replay.poll(Seconds(9)), recording.frames[3].input);
    EXPECT_TRUE(replay.finished());
    EXPECT_EQ(replay.poll(Seconds(10)), recording.frames[3].input);
}

TEST(ReplayInput, AnEmptyRecordingIsFinished) {
    const Recording recording;
    ReplayInput replay(recording);
    EXPECT_TRUE(replay.finished());
    EXPECT_TRUE(replay.poll(Seconds(1)).devices.empty());
}

} // namespace
} // namespace isochron::interaction
