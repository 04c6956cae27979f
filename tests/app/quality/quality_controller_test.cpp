// The choice of the footprint with simulated costs: it fits the budget, is stable, and never stays
// too low.
#include "tests/app/frame/quality_fixture.h"
#include "tests/support/test_seed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace isochron::app {
namespace {

TEST_F(QualityControllerTest, SettledEndsAtTheBestThatFitsAndSaysSo) {
    for (int trial = 0; trial < tries(400); ++trial) {
        const Costs costs = random_costs();
        SimulatedDisplay display(kBudget, constant(costs));
        display.latency = trial % 5;
        display.still = chance(0.5);
        const QualityChoice choice = display.run(60).choice;
        const Footprint best = best_that_fits(costs);
        SCOPED_TRACE(testing::Message() << costs[0] << " " << costs[1] << " " << costs[2]);
        // Footprints that do not fit are tried again now and then.
        if (best == Footprint::surface) {
            EXPECT_EQ(choice.footprint, best);
            EXPECT_TRUE(choice.final);
            EXPECT_EQ(choice.reason, QualityReason::fits);
        }
        display.run(20000);
        EXPECT_GT(display.at(best, 60), 19500);
        expect_no_flicker(display);
    }
}

TEST_F(QualityControllerTest, AnEmptySceneTeachesNothingOfCells) {
    // Each footprint takes next to nothing without cells, and the surface far too long with them.
    SimulatedDisplay display(kBudget, [](Footprint footprint, const DrawLoad& load) {
        constexpr std::array kPerCell{1e-4, 3e-4, 30e-4};
        return 0.01 + load.cells * kPerCell[rung(footprint)];
    });
    display.input.load.cells = 0;
    const QualityChoice empty = display.run(200).choice;
    EXPECT_TRUE(empty.final) << "a capture of nothing need not wait";
    EXPECT_FALSE(empty.measure);
    display.input.load.cells = 2e4;
    EXPECT_NE(display.frame().choice.footprint, Footprint::surface) << "60 ms at a guess";
    EXPECT_EQ(display.run(200).choice.footprint, Footprint::gaussian);
    EXPECT_LE(display.over_budget(), 4);
}

TEST_F(QualityControllerTest, MotionThatMayNotMeasureAndFastModeDrawQuadsAtOnce) {
    SimulatedDisplay display(kBudget, constant({1, 2, 3}));
    display.input.by_pace = true;
    display.run(100);
    ASSERT_EQ(display.frames.back().choice.footprint, Footprint::surface);
    display.input.pace = Pace::moving;
    EXPECT_EQ(display.frame().choice.footprint, Footprint::quad);
    EXPECT_FALSE(display.frames.back().choice.final);
    display.input.pace = Pace::settled;
    EXPECT_EQ(display.frame().choice.footprint, Footprint::surface) << "it is known to fit";
    display.input.mode = QualityMode::fast;
    EXPECT_EQ(display.frame().choice.footprint, Footprint::quad);
    EXPECT_TRUE(display.frames.back().choice.final) << "nothing better will come";
}

TEST_F(QualityControllerTest, QualityModeDrawsTheBestWhateverItCostsAlsoWhileTimePlays) {
    SimulatedDisplay display(kBudget, constant({1, 5, 300}));
    display.input.mode = QualityMode::quality;
    display.run(100);
    EXPECT_EQ(display.at(Footprint::surface), 100);
    EXPECT_TRUE(display.frames.front().choice.final);
    display.input.playing = true;
    const std::size_t first = display.frames.size();
    display.run(200);
    EXPECT_EQ(display.at(Footprint::surface, first), 200);
}

TEST_F(QualityControllerTest, AFixedFootprintIsTakenWithoutMeasuring) {
    SimulatedDisplay display(kBudget, constant({1, 300, 300}));
    for (const Footprint fixed : {Footprint::gaussian, Footprint::surface}) {
        display.input.settled = fixed;
        display.input.pace = Pace::settled;
        for (int i = 0; i < 50; ++i) {
            EXPECT_EQ(display.frame().choice.footprint, fixed);
            EXPECT_FALSE(display.frames.back().choice.measure);
        }
        display.input.pace = Pace::moving;
        EXPECT_EQ(display.frame().choice.footprint, Footprint::quad);
    }
    display.input.pace = Pace::settled;
    display.input.available = render::FootprintSet::up_to(Footprint::gaussian);
    EXPECT_EQ(display.frame().choice.footprint, Footprint::gaussian) << "surface cannot be drawn";
}

TEST_F(QualityControllerTest, NothingBetterThanTheCellsAllowIsChosen) {
    SimulatedDisplay display(kBudget, constant({1, 2, 3}));
    display.run(100);
    display.input.available = render::FootprintSet::up_to(Footprint::gaussian);
    EXPECT_EQ(display.frame().choice.footprint, Footprint::gaussian);
    display.run(100);
    EXPECT_EQ(display.at(Footprint::surface, 100), 0);
    EXPECT_TRUE(display.frames.back().choice.final);
    display.input.available.add(Footprint::surface);
    EXPECT_EQ(display.frame().choice.footprint, Footprint::surface);
}

TEST_F(QualityControllerTest, AStillPictureIsDrawnNoMoreThanItTakesToMeasureIt) {
    SimulatedDisplay display(kBudget, constant({1, 2, 3}));
    display.run(1000);
    const auto drawn = std::ranges::count_if(display.frames, &SimulatedDisplay::Frame::drawn);
    EXPECT_LE(drawn, 8);
    EXPECT_NEAR(display.frames.back().choice.cost->count(), 3, 0.01);
}

TEST_F(QualityControllerTest,
       WhatCompilingTookOfTheFirstPicturesDoesNotKeepAnythingFromBeingTried) {
    for (const int compiled : {1, 2, 3}) {
        int quads = 0;
        SimulatedDisplay display(kBudget, [&](Footprint footprint, const DrawLoad&) {
            return footprint != Footprint::quad ? 4.0 : quads++ < compiled ? 120.0 : 2.0;
        });
        EXPECT_EQ(display.run(60).choice.footprint, Footprint::surface) << compiled << " pictures";
        EXPECT_TRUE(display.frames.back().choice.final);
    }
}

TEST_F(QualityControllerTest, WhatQuadsThatAreSlowSpeakAgainstIsNotTriedAfterThreeMeasurements) {
    for (int latency = 0; latency < 5; ++latency) {
        SimulatedDisplay display(kBudget, constant({120, 4, 4}));
        display.latency = latency;
        const QualityChoice choice = display.run(60).choice;
        EXPECT_EQ(display.at(Footprint::quad), 60);
        EXPECT_TRUE(choice.final);
        EXPECT_EQ(choice.reason, QualityReason::over_budget);
        const auto drawn = std::ranges::count_if(display.frames, &SimulatedDisplay::Frame::drawn);
        EXPECT_LE(drawn, 4 + latency) << "the first one does not count";
    }
}

TEST_F(QualityControllerTest, AMeasurementOverTheBudgetEndsItAtOnce) {
    for (int latency = 0; latency < 5; ++latency) {
        Costs costs{1, 2, 3};
        SimulatedDisplay display(
            kBudget, [&](Footprint footprint, const DrawLoad&) { return costs[rung(footprint)]; });
        display.latency = latency;
        display.still = false;
        display.run(500);
        costs[2] = 11;
        const std::size_t first = display.frames.size();
        display.run(10);
        EXPECT_EQ(display.over_budget(first), latency + 1);
        EXPECT_EQ(display.frames.back().choice.footprint, Footprint::gaussian);
        EXPECT_EQ(display.frames.back().choice.reason, QualityReason::over_budget);
        EXPECT_NEAR(display.frames.back().choice.better_cost->count(), 11, 0.01);
    }
}

TEST_F(QualityControllerTest, OneLoadCausesFewFramesOverTheBudget) {
    for (int latency = 0; latency < 5; ++latency) {
        SimulatedDisplay display(kBudget, constant({1, 12, 40}));
        display.latency = latency;
        display.still = false;
        constexpr int kFrames = 100000;
        display.run(kFrames);
        // Each of two footprints: one trial per doubling of the wait, then one per longest wait.
        const int trials = 2 * (8 + kFrames / int(QualityController::kLongestWait) + 1);
        EXPECT_LE(display.over_budget(), trials * (latency + 2));
        expect_no_flicker(display);
    }
}

TEST_F(QualityControllerTest, NoiseAroundTheBudgetDoesNotFlicker) {
    SimulatedDisplay display(kBudget, [&](Footprint footprint, const DrawLoad&) {
        return footprint == Footprint::surface ? uniform(9, 11) : 1.0;
    });
    display.still = false;
    constexpr int kFrames = 40000;
    display.run(kFrames);
    int changes = 0;
    for (std::size_t i = 1; i < display.frames.size(); ++i)
        changes += display.frames[i].choice.footprint != display.frames[i - 1].choice.footprint;
    EXPECT_LE(changes, 2 * (8 + kFrames / int(QualityController::kLongestWait) + 2));
    expect_no_flicker(display);
}

TEST_F(QualityControllerTest, ASpikeCostsAMomentOfQualityAndNoMore) {
    SimulatedDisplay display(kBudget, [&](Footprint, const DrawLoad&) {
        return chance(0.001) ? uniform(20, 500) : 5.0;
    });
    display.still = false;
    display.run(50000);
    EXPECT_GT(display.at(Footprint::surface), 46000);
    expect_no_flicker(display);
}

TEST_F(QualityControllerTest, WithMoreCellsItLeavesBeforeTheFirstSlowFrame) {
    const auto by_cells = [](Footprint footprint, const DrawLoad& load) {
        return (0.2 + 8e-5 * load.cells) * (1 + static_cast<double>(rung(footprint)));
    };
    SimulatedDisplay display(kBudget, by_cells);
    display.still = false;
    for (int i = 0; i < 300; ++i) {
        display.input.load.cells = uniform(5e3, 2e4);
        display.frame();
    }
    ASSERT_EQ(display.frames.back().choice.footprint, Footprint::surface);
    display.input.load.cells = 1e5; // 8 ms in quads, 16 and 25 ms in the others
    const std::size_t first = display.frames.size();
    display.run(10);
    EXPECT_EQ(display.frames[first].choice.footprint, Footprint::quad);
    EXPECT_EQ(display.over_budget(first), 0);
    display.input.load.cells = 1e4;
    display.run(40);
    EXPECT_EQ(display.frames.back().choice.footprint, Footprint::surface);
}

TEST_F(QualityControllerTest, FewerCellsEndTheLongestWaitAtOnce) {
    SimulatedDisplay display(kBudget, [](Footprint footprint, const DrawLoad& load) {
        return 1e-4 * load.cells * (1 + static_cast<double>(rung(footprint)));
    });
    display.still = false;
    display.input.load.cells = 1e5;
    display.run(20000); // the waits are at their longest
    ASSERT_EQ(display.frames.back().choice.footprint, Footprint::quad);
    display.input.load.cells = 1e4;
    display.run(40);
    EXPECT_EQ(display.frames.back().choice.footprint, Footprint::surface);
}

TEST_F(QualityControllerTest, ALoadOfOthersThatEndsIsNoticedWithinTheLongestWait) {
    for (const bool still : {false, true}) {
        double others = 10;
        SimulatedDisplay display(kBudget, [&](Footprint footprint, const DrawLoad&) {
            return others * (1 + static_cast<double>(rung(footprint)));
        });
        display.still = still;
        display.run(20000);
        ASSERT_EQ(display.frames.back().choice.footprint, Footprint::quad);
        others = 1;
        display.run(QualityController::kLongestWait + 40);
        EXPECT_EQ(display.frames.back().choice.footprint, Footprint::surface);
    }
}

TEST_F(QualityControllerTest, OldMeasurementsDoNotSpeakAgainstWhatFitsNow) {
    double others = 10;
    SimulatedDisplay display(kBudget, [&](Footprint footprint, const DrawLoad& load) {
        return others * 4e-5 * load.cells * (1 + static_cast<double>(rung(footprint)));
    });
    display.still = false;
    const auto run = [&](int frames) {
        for (int i = 0; i < frames; ++i) {
            display.input.load.cells = uniform(1e4, 2e4);
            display.frame();
        }
    };
    run(20000);
    EXPECT_LE(display.over_budget(), 20000 / 130) << "cells that vary are no reason to try again";
    others = 1;
    run(QualityController::kLongestWait + 40);
    const std::size_t first = display.frames.size();
    run(1000);
    EXPECT_EQ(display.at(Footprint::surface, first), 1000);
}

TEST_F(QualityControllerTest, ACostThatRoseInTheMeantimeIsNoticedInAStillPicture) {
    double scale = 1;
    SimulatedDisplay display(kBudget, [&](Footprint footprint, const DrawLoad&) {
        return footprint == Footprint::surface ? 3 * scale : 1;
    });
    display.run(100);
    ASSERT_EQ(display.frames.back().choice.footprint, Footprint::surface);
    display.input.pace = Pace::moving;
    display.input.by_pace = true;
    display.run(10);
    display.input.by_pace = false;
    scale = 10;
    display.input.pace = Pace::settled;
    EXPECT_EQ(display.frame().choice.footprint, Footprint::surface) << "it did fit";
    EXPECT_EQ(display.run(10).choice.footprint, Footprint::gaussian);
    EXPECT_TRUE(display.frames.back().choice.final);
}

/// A display in any state: whatever paces, modes, loads and costs came before.
void stir(SimulatedDisplay& display, std::mt19937& random, int frames) {
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<>(low, high)(random);
    };
    const SimulatedDisplay::Cost quiet = display.cost;
    for (int i = 0; i < frames; ++i) {
        if (random() % 20 == 0)
            display.input.pace = static_cast<Pace>(random() % 2);
        if (random() % 40 == 0)
            display.input.mode = static_cast<QualityMode>(random() % 3);
        if (random() % 40 == 0)
            display.input.playing = random() % 2 == 0;
        if (random() % 100 == 0)
            display.input.available =
                render::FootprintSet::up_to(static_cast<Footprint>(1 + random() % 3));
        if (random() % 10 == 0)
            display.input.load = {uniform(0, 1e6), uniform(0, 1e7)};
        if (random() % 30 == 0)
            display.latency = static_cast<int>(random() % 5);
        if (random() % 30 == 0)
            display.cost = [scale = std::exp(uniform(-4, 3)), &random](Footprint f,
                                                                       const DrawLoad& load) {
                return scale * (1 + 1e-5 * load.cells * (1 + static_cast<double>(rung(f)))) *
                       (random() % 50 == 0 ? 20 : 1);
            };
        display.frame();
    }
    display.cost = quiet;
    display.input = SimulatedDisplay::settled_input();
}

TEST_F(QualityControllerTest, FromAnyStateItReturnsToTheBestThatFits) {
    for (int trial = 0; trial < tries(300); ++trial) {
        SCOPED_TRACE(testing::Message() << "trial " << trial);
        const Costs costs = random_costs();
        SimulatedDisplay display(kBudget, constant(costs));
        display.still = chance(0.5);
        stir(display, random_, 3000);
        const Footprint best = best_that_fits(costs);
        // A gaussian below a surface that does not fit waits its turn, too.
        constexpr int kBound = 2 * (int(QualityController::kLongestWait) + 40);
        display.run(kBound);
        const std::size_t first = display.frames.size();
        display.run(4000);
        EXPECT_GT(display.at(best, first), 3900) << costs[0] << " " << costs[1] << " " << costs[2];
    }
}

TEST_F(QualityControllerTest, CostsThatTurnAgainstEveryChoiceDoNotMakeItFlicker) {
    SimulatedDisplay display(kBudget, {});
    // Whatever was chosen for a while becomes too slow.
    int same = 0;
    Footprint last = Footprint::quad;
    display.cost = [&](Footprint footprint, const DrawLoad&) {
        same = footprint == last ? same + 1 : 0;
        last = footprint;
        return same > 3 ? 30.0 : 2.0;
    };
    display.still = false;
    display.run(50000);
    EXPECT_GT(display.at(Footprint::quad), 40000);
    expect_no_flicker(display);
}

} // namespace
} // namespace isochron::app
