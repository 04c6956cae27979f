// The number of pixels in which cells of moving pictures are drawn.
#include "app/quality/cell_resolution.h"

#include <gtest/gtest.h>

#include <random>

namespace isochron::app {
namespace {

using interaction::Seconds;

constexpr Milliseconds kOfFrame{16};

TEST(CellResolution, IsTheFinestThatFits) {
    for (const double cost : {1.0, 14.0, 17.0, 21.0, 27.0, 90.0}) {
        SCOPED_TRACE(cost);
        CellResolution resolution;
        const std::size_t step = resolution.choose(Milliseconds(cost), kOfFrame, Seconds(0));
        EXPECT_EQ(step == 0, cost <= 0.9 * 16);
        if (step > 0) {
            EXPECT_GT(resolution.share(step - 1) * cost, 0.9 * 16);
        }
        EXPECT_TRUE(resolution.share(step) * cost <= 0.9 * 16 ||
                    step + 1 == kCellResolutions.size());
    }
    for (const double least : {1.0, 0.71, 0.5, 0.35}) {
        CellResolution resolution(least);
        const std::size_t step = resolution.choose(Milliseconds(1000), kOfFrame, Seconds(0));
        EXPECT_NEAR(kCellResolutions[step], least, 1e-6);
    }
    CellResolution unknown;
    EXPECT_EQ(unknown.choose(std::nullopt, kOfFrame, Seconds(0)), 0u);
}

TEST(CellResolution, ChangesAtMostTwiceASecondAndNotWhereTimesScatter) {
    std::mt19937 random(4);
    CellResolution calm, wild;
    int of_calm = 0, of_wild = 0;
    std::size_t was_calm = 0, was_wild = 0;
    double last = -1;
    for (int i = 0; i < 600; ++i) {
        const double now = i / 60.0;
        const auto scattered = [&](double low, double high) {
            return Milliseconds(std::uniform_real_distribution(low, high)(random));
        };
        const std::size_t of_now = calm.choose(scattered(17.0, 17.6), kOfFrame, Seconds(now));
        of_calm += of_now != was_calm;
        was_calm = of_now;
        const std::size_t of_all = wild.choose(scattered(3, 90), kOfFrame, Seconds(now));
        if (of_all != was_wild) {
            EXPECT_TRUE(last < 0 || now - last >= 0.5) << now;
            last = now;
            ++of_wild;
        }
        was_wild = of_all;
    }
    EXPECT_EQ(of_calm, 1);
    EXPECT_GT(of_wild, 5);
}

TEST(CellResolution, IsNotTakenWhereItSavesNothing) {
    CellResolution resolution;
    for (int i = 0; i < 200; ++i)
        for (std::size_t step = 1; step < kCellResolutions.size(); ++step)
            resolution.learn(step, 1.0);
    EXPECT_EQ(resolution.choose(Milliseconds(100), kOfFrame, Seconds(0)), 0u);
}

TEST(CellResolution, DoesNotBelieveThatFewerPixelsSaveOrCostWhatTheyCannot) {
    CellResolution resolution;
    const double before = resolution.share(2);
    EXPECT_EQ(resolution.learn(2, 0.05), before)
        << "all pixels cannot have taken twenty times as long";
    EXPECT_EQ(resolution.learn(2, 5), before);
    EXPECT_EQ(resolution.share(2), before);
    EXPECT_EQ(resolution.learn(2, 0.5), 0.5);
    EXPECT_EQ(resolution.share(2), 0.5);
}

} // namespace
} // namespace isochron::app
