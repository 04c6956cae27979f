// Captures wait for cells and quality, but not forever.
#include "app/quality/capture_wait.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace isochron::app {
namespace {

using interaction::Seconds;

const index::SurfacesQuery kBefore{index::Instant(0), {1.0}}, kAsked{index::Instant(0), {2.0}};

CaptureView view(double time, const index::SurfacesQuery& asked,
                 const std::optional<index::SurfacesQuery>& shown, bool final) {
    return {.time = Seconds(time), .asked = asked, .shown = shown, .final = final};
}

TEST(CaptureWait, NothingIsTakenThatWasNotAskedFor) {
    CaptureWait wait;
    for (int frame = 0; frame < 100; ++frame)
        EXPECT_FALSE(wait.take(view(frame, kAsked, kAsked, true)));
}

TEST(CaptureWait, TakesEachOnceWhenThePictureIsFinal) {
    CaptureWait wait;
    wait.ask();
    wait.ask();
    EXPECT_FALSE(wait.take(view(0, kAsked, std::nullopt, true)));
    EXPECT_FALSE(wait.take(view(1, kAsked, kBefore, true)));
    EXPECT_FALSE(wait.take(view(2, kAsked, kAsked, false)));
    EXPECT_TRUE(wait.take(view(3, kAsked, kAsked, true)));
    EXPECT_TRUE(wait.take(view(4, kAsked, kAsked, true)));
    EXPECT_FALSE(wait.take(view(5, kAsked, kAsked, true)));
}

TEST(CaptureWait, SaysThatAPictureIsComingUntilItIsTaken) {
    CaptureWait wait;
    EXPECT_EQ(wait.note(), "");
    wait.ask();
    EXPECT_FALSE(wait.take(view(0, kAsked, kBefore, true)));
    EXPECT_NE(wait.note().find("saving a picture"), std::string::npos);
    wait.ask();
    EXPECT_NE(wait.note().find("2 pictures"), std::string::npos);
    EXPECT_TRUE(wait.take(view(1, kAsked, kAsked, true)));
    EXPECT_TRUE(wait.take(view(2, kAsked, kAsked, true)));
    EXPECT_EQ(wait.note(), "");
}

TEST(CaptureWait, OneQuerysCellsAreWaitedForAsLongAsTheyTake) {
    CaptureWait wait;
    wait.ask();
    for (int frame = 0; frame < 10000; ++frame)
        ASSERT_FALSE(wait.take(view(frame, kAsked, kBefore, frame % 2 == 0)));
    EXPECT_FALSE(wait.take(view(10000, kAsked, kAsked, false)));
    EXPECT_TRUE(wait.take(view(10001, kAsked, kAsked, true)));
}

TEST(CaptureWait, CellsThatWillNotComeAreNotWaitedFor) {
    CaptureWait wait;
    wait.ask();
    CaptureView failed = view(0, kAsked, kBefore, true);
    EXPECT_FALSE(wait.take(failed));
    failed.failed = true;
    EXPECT_TRUE(wait.take(failed));
    wait.ask();
    failed.shown.reset();
    EXPECT_FALSE(wait.take(failed)) << "there is nothing to see";
}

TEST(CaptureWait, WhatWasBeforeItWasWantedIsNotCounted) {
    for (const bool is_called : {false, true}) { // by the session in each frame, by others not
        CaptureWait wait;
        wait.ask();
        EXPECT_TRUE(wait.take(view(0, kBefore, kBefore, true)));
        if (is_called)
            EXPECT_FALSE(wait.take(view(1, kBefore, kBefore, true)));
        wait.ask();
        EXPECT_FALSE(wait.take(view(3600, kAsked, kBefore, true))) << is_called;
        EXPECT_FALSE(wait.take(view(3601, kAsked, kAsked, false))) << is_called;
        EXPECT_TRUE(wait.take(view(3602, kAsked, kAsked, true)));
    }
}

TEST(CaptureWait, APictureThatIsBeingMadeIsWaitedForAsLongAsItTakes) {
    CaptureWait wait;
    wait.ask();
    CaptureView made = view(0, kAsked, kAsked, false);
    made.improves = true;
    for (int frame = 0; frame < 10000; ++frame, made.time += Seconds(1))
        ASSERT_FALSE(wait.take(made));
    made.final = true;
    EXPECT_TRUE(wait.take(made));
}

/// Frames at 10 Hz until the capture is taken; the time of that, or 1000 seconds.
double taken_at(CaptureWait& wait, const std::function<CaptureView(double)>& at) {
    double time = 0;
    for (int frame = 0; frame < 10000; ++frame, time += 0.1)
        if (wait.take(at(time)))
            break;
    return time;
}

TEST(CaptureWait, SomeSlowFramesAreNoMotionThatDoesNotEnd) {
    CaptureWait wait;
    wait.ask();
    double time = 0;
    for (int frame = 0; frame < 8; ++frame, time += 6) // a large picture on a busy processor
        EXPECT_FALSE(wait.take(view(time, kAsked, kAsked, false))) << time;
    EXPECT_TRUE(wait.take(view(time, kAsked, kAsked, true)));
    wait.ask();
    int frames = 0;
    for (; frames < 100 && !wait.take(view(time, kAsked, kAsked, false)); ++frames)
        time += 6;
    EXPECT_EQ(frames, CaptureWait::kPatience / CaptureWait::kOfFrame);
}

TEST(CaptureWait, MotionThatDoesNotEndIsWaitedForNoLongerThanThePatience) {
    const auto restless = [](double time) { return view(time, kAsked, kAsked, false); };
    const auto playing = [](double time) {
        const auto step = static_cast<std::uint32_t>(time * 4);
        return view(time, {index::Instant(step + 1), {1.0}},
                    index::SurfacesQuery{index::Instant(step), {1.0}}, false);
    };
    const auto playing_fast = [&](double time) {
        CaptureView now = playing(time);
        now.final = true;
        return now;
    };
    for (const std::function<CaptureView(double)>& at :
         {std::function<CaptureView(double)>(restless), std::function<CaptureView(double)>(playing),
          std::function<CaptureView(double)>(playing_fast)}) {
        CaptureWait wait;
        for (int capture = 0; capture < 2; ++capture) {
            wait.ask();
            EXPECT_NEAR(taken_at(wait, at), CaptureWait::kPatience.count(), 0.25);
            EXPECT_FALSE(wait.take(view(0, kAsked, kAsked, true)));
        }
    }
}

} // namespace
} // namespace isochron::app
