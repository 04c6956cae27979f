// When a loop waits: by the count of frames, and by a clock that the test moves.
#include "app/frame/idle_wait.h"

#include <gtest/gtest.h>

namespace isochron::app {
namespace {

using interaction::Seconds;

constexpr FrameOutlook kFinal{.final = true};

/// Frames until it waits, at most `most`. @param frame is the same for all
int frames_until_wait(IdleWait& idle, const FrameOutlook& frame, int most, double apart,
                      double from = 0) {
    for (int i = 1; i <= most; ++i)
        if (idle.after(frame, Seconds(from + i * apart)))
            return i;
    return most + 1;
}

TEST(IdleWait, WaitsAFewFramesAfterTheLastChangeOfAFinalPicture) {
    IdleWait idle;
    EXPECT_FALSE(idle.after({.changed = true, .final = true}, Seconds(0)));
    for (int i = 1; i < IdleWait::kFramesAfter; ++i)
        EXPECT_FALSE(idle.after(kFinal, Seconds(i)));
    EXPECT_EQ(idle.after(kFinal, Seconds(9)), FrameOutlook::kNever);
    EXPECT_EQ(idle.after(kFinal, Seconds(10)), FrameOutlook::kNever);
    EXPECT_FALSE(idle.after({.changed = true, .final = true}, Seconds(11)));
    EXPECT_EQ(frames_until_wait(idle, kFinal, 99, 1e-3, 11), IdleWait::kFramesAfter);
}

TEST(IdleWait, NeverWaitsWhileSomethingIsHeldOrGoesOn) {
    IdleWait idle;
    EXPECT_EQ(frames_until_wait(idle, {.busy = true, .final = true}, 1000, 1), 1001);
    EXPECT_EQ(frames_until_wait(idle, {.changed = true, .final = true}, 1000, 1), 1001);
}

TEST(IdleWait, APictureThatIsNotFinalHasTheFramesThatChoicesCountAndTheTimeThatTheyTake) {
    IdleWait fast, slow;
    EXPECT_FALSE(fast.after({.changed = true}, Seconds(0)));
    EXPECT_EQ(frames_until_wait(fast, {}, 5000, 1e-3), 2000) << "two seconds";
    EXPECT_FALSE(slow.after({.changed = true}, Seconds(0)));
    EXPECT_EQ(frames_until_wait(slow, {}, 5000, 1), IdleWait::kFramesUnfinished);
}

TEST(IdleWait, WaitsNoLongerThanUntilTheNextMoment) {
    IdleWait idle;
    FrameOutlook frame{.final = true, .until = Seconds(30)};
    frames_until_wait(idle, frame, 9, 1e-3);
    EXPECT_EQ(idle.after(frame, Seconds(10)), Seconds(20));
    EXPECT_EQ(idle.after(frame, Seconds(31)), Seconds(0)) << "it is late already";
}

TEST(IdleWait, OfTwoOutlooksTheOneThatHasMoreToDoCounts) {
    const FrameOutlook one{.busy = true, .final = true, .until = Seconds(2)},
        other{.changed = true};
    for (const FrameOutlook& all : {both(one, other), both(other, one)}) {
        EXPECT_TRUE(all.busy && all.changed);
        EXPECT_FALSE(all.final);
        EXPECT_EQ(all.until, Seconds(2));
    }
}

} // namespace
} // namespace isochron::app
