// The time promised for moving pictures: recognition before the rate, and nothing flaps.
#include "app/quality/motion_promise.h"

#include <gtest/gtest.h>

#include <random>

namespace isochron::app {
namespace {

using interaction::Seconds;

constexpr Milliseconds kPeriod{1000.0 / 60};
constexpr MotionPromise::Limits kScreen{MotionPromise::kAtEase, MotionPromise::kLongest};

/// Where presenting takes most of a frame, as in a window of a processor.
MotionCosts costs(double of_million_cells) {
    return {.beside = Milliseconds(5),
            .fixed = Milliseconds(4),
            .of_cell = Milliseconds(of_million_cells / 1e6)};
}

Milliseconds taken(const MotionCosts& costs, double cells) {
    return costs.beside + costs.fixed + cells * costs.of_cell;
}

TEST(MotionPromise, IsTheWantedTimeWhereThisHoldsAllCellsOrNothingIsKnown) {
    MotionPromise promise(kPeriod, kScreen);
    promise.update(std::nullopt, 1'000'000, Seconds(1));
    promise.update(costs(100), std::nullopt, Seconds(2));
    promise.update(costs(100), 0, Seconds(3));
    promise.update(costs(100), 30'000, Seconds(4));
    EXPECT_EQ(promise.time(), kPeriod);
}

TEST(MotionPromise, HoldsAllCellsAt30PicturesASecondAndAnEighthAt10) {
    for (const double cells : {150e3, 260e3, 1e6, 3e6, 5e6, 50e6}) {
        SCOPED_TRACE(cells);
        MotionPromise promise(kPeriod, kScreen);
        promise.update(costs(100), static_cast<std::uint64_t>(cells), Seconds(1));
        const Milliseconds time = promise.time();
        EXPECT_GE(time, kPeriod);
        EXPECT_LE(time, MotionPromise::kLongest);
        const Milliseconds all = taken(costs(100), cells), eighth = taken(costs(100), cells / 8);
        EXPECT_TRUE(time >= all || all > Milliseconds(25));
        EXPECT_TRUE(time >= eighth || time == MotionPromise::kLongest);
        EXPECT_TRUE(time <= MotionPromise::kAtEase || time <= 1.5 * eighth) << "as short as can be";
    }
}

TEST(MotionPromise, OfAHeadsetOrWhereNoLongerTimeMayBePromisedIsTheWantedTime) {
    MotionPromise headset(kPeriod), strict(kPeriod, {Milliseconds(0), Milliseconds(0)});
    for (MotionPromise* promise : {&headset, &strict}) {
        promise->update(costs(1000), 5'000'000, Seconds(1));
        EXPECT_EQ(promise->time(), kPeriod);
    }
}

TEST(MotionPromise, ChangesAtMostTwiceASecondAndNotWhereTimesScatter) {
    std::mt19937 random(5);
    MotionPromise calm(kPeriod, kScreen), wild(kPeriod, kScreen);
    int of_calm = 0, of_wild = 0;
    Milliseconds before = wild.time();
    double last = -1;
    for (int i = 0; i < 1200; ++i) {
        const double now = i / 60.0;
        const Milliseconds was = calm.time();
        calm.update(costs(100 * std::uniform_real_distribution(0.97, 1.03)(random)), 200'000,
                    Seconds(now));
        of_calm += calm.time() != was;
        wild.update(costs(100 * std::uniform_real_distribution(0.2, 5.0)(random)), 2'000'000,
                    Seconds(now));
        if (wild.time() != before) {
            EXPECT_TRUE(last < 0 || now - last >= 0.5) << now;
            last = now;
            ++of_wild;
        }
        before = wild.time();
    }
    EXPECT_EQ(of_calm, 1);
    EXPECT_GT(of_wild, 5);
    EXPECT_LE(of_wild, 40);
    wild.update(costs(1), 100'000, Seconds(30));
    EXPECT_EQ(wild.time(), kPeriod) << "a rate that was lost comes back";
}

TEST(MotionPromise, AMovingPictureHasAnEighthOfTheCells) {
    EXPECT_EQ(least_recognized(800'000), 100'000u);
    EXPECT_EQ(least_recognized(std::nullopt), 0u);
}

} // namespace
} // namespace isochron::app
