// The footprints that are drawn while something moves, and those that are never tried.
#include "tests/app/frame/quality_fixture.h"

#include <tuple>
#include <utility>

namespace isochron::app {
namespace {

class QualityInMotion : public QualityControllerTest {};

TEST_F(QualityInMotion, MotionDrawsTheBestThatIsKnownToFitWithRoomToSpare) {
    for (const auto& [costs, wanted] : {std::pair{Costs{1, 2, 3}, Footprint::surface},
                                        {Costs{1, 2, 9}, Footprint::gaussian},
                                        {Costs{1, 8, 9}, Footprint::quad},
                                        {Costs{1, 9, 7}, Footprint::surface},
                                        {Costs{12, 30, 30}, Footprint::quad}}) {
        SCOPED_TRACE(testing::Message() << costs[0] << " " << costs[1] << " " << costs[2]);
        SimulatedDisplay display(kBudget, constant(costs));
        display.run(100); // at rest
        display.input.pace = Pace::moving;
        const std::size_t first = display.frames.size();
        EXPECT_EQ(display.frame().choice.footprint, wanted) << "from the first frame on";
        display.run(3000);
        EXPECT_EQ(display.at(wanted, first), 3001);
        EXPECT_FALSE(display.frames.back().choice.final);
        EXPECT_EQ(display.frames.back().choice.reason, QualityReason::moving);
    }
}

TEST_F(QualityInMotion, MotionFromTheStartLearnsWithoutASlowFrame) {
    for (int latency = 0; latency < 5; ++latency) {
        SimulatedDisplay display(kBudget, constant({0.5, 2, 5}));
        display.latency = latency;
        display.input.pace = Pace::moving;
        display.run(60);
        EXPECT_EQ(display.frames.back().choice.footprint, Footprint::surface);
        EXPECT_EQ(display.over_budget(), 0);
        // Where quads take so long that nothing else may be tried, they stay.
        SimulatedDisplay slow(kBudget, constant({8, 2, 5}));
        slow.latency = latency;
        slow.input.pace = Pace::moving;
        slow.run(3000);
        EXPECT_EQ(slow.at(Footprint::quad), 3000);
    }
}

TEST_F(QualityInMotion, MotionDoesNotFlickerWhateverItCosts) {
    for (int trial = 0; trial < tries(40); ++trial) {
        const Costs costs = random_costs();
        SimulatedDisplay display(kBudget, [&](Footprint footprint, const DrawLoad& load) {
            return costs[rung(footprint)] * uniform(0.7, 1.4) * (0.5 + load.cells / 1e4);
        });
        display.latency = trial % 5;
        display.still = false;
        display.input.pace = Pace::moving;
        for (int i = 0; i < 2000; ++i) {
            if (chance(0.1))
                display.input.load.cells = uniform(1e3, 2e4);
            display.frame();
        }
        expect_no_flicker(display);
        const int floor = display.over_budget() - 2000 / 16 * (display.latency + 1);
        EXPECT_LE(floor, display.at(Footprint::quad)) << "only quads may take so long";
    }
}

TEST_F(QualityInMotion, ALoadOfOthersThatEndsIsNoticedThoughNothingComesToRest) {
    double others = 10;
    SimulatedDisplay display(kBudget, [&](Footprint footprint, const DrawLoad&) {
        return others * (2 + static_cast<double>(rung(footprint)));
    });
    display.run(200); // at rest: 20, 30 and 40 ms
    display.input.pace = Pace::moving;
    display.run(200);
    ASSERT_EQ(display.frames.back().choice.footprint, Footprint::quad);
    others = 1;
    EXPECT_NE(display.run(600).choice.footprint, Footprint::quad)
        << "eight times the time of quads, at most, would be too long";
}

TEST_F(QualityInMotion, WhatOnceFailedByAccidentIsTriedAgainAndDearThingsNever) {
    for (const double accident : {25.0, 400.0}) {
        bool now = true;
        SimulatedDisplay display(kBudget, [&](Footprint footprint, const DrawLoad&) {
            return footprint == Footprint::quad ? 3.0 : now ? accident : 4.0;
        });
        display.run(100);
        now = false;
        display.input.pace = Pace::moving;
        const std::size_t first = display.frames.size();
        display.run(4 * QualityController::kLongestWait);
        EXPECT_EQ(display.over_budget(first), 0);
        EXPECT_EQ(display.frames.back().choice.footprint != Footprint::quad, accident < 100);
        // Where it is no accident, it costs one late frame in a thousand.
        now = true;
        const std::size_t again = display.frames.size();
        display.run(8 * QualityController::kLongestWait);
        EXPECT_LE(display.over_budget(again), 16);
    }
}

TEST_F(QualityInMotion, WhatIsTriedAgainLastsUntilItsTimeIsKnown) {
    bool now = true;
    SimulatedDisplay display(kBudget, [&](Footprint footprint, const DrawLoad&) {
        return footprint == Footprint::quad ? 3.0 : now ? 25.0 : 4.0;
    });
    display.latency = 3;
    display.run(200);
    now = false;
    display.input.pace = Pace::moving;
    const std::size_t first = display.frames.size();
    display.run(4 * QualityController::kLongestWait);
    int changes = 0;
    for (std::size_t i = first + 1; i < display.frames.size(); ++i)
        changes += display.frames[i].choice.footprint != display.frames[i - 1].choice.footprint;
    EXPECT_EQ(display.frames.back().choice.footprint, Footprint::surface);
    EXPECT_LE(changes, 2);
}

TEST_F(QualityInMotion, ATrialEndsWhereThereAreManyMoreCells) {
    SimulatedDisplay display(100, [](Footprint footprint, const DrawLoad& load) {
        return load.cells * (footprint == Footprint::quad ? 1e-3 : 2e-3);
    });
    display.input.in_parts = Footprint::surface;
    display.latency = 3;
    display.run(2);
    while (display.frames.back().choice.footprint == Footprint::quad)
        display.frame();
    ASSERT_EQ(display.frames.back().choice.footprint, Footprint::gaussian);
    display.input.load.cells *= 40; // before its time is known
    EXPECT_EQ(display.frame().choice.footprint, Footprint::quad);
}

TEST_F(QualityInMotion, BesidePartsNothingIsTriedThatTakesLong) {
    // At rest the surface comes in parts; gaussians may take 8 times as long as quads.
    SimulatedDisplay display(200, constant({10, 60, 90}));
    display.input.in_parts = Footprint::surface;
    SimulatedDisplay tight(kBudget, constant({20, 120, 150}));
    tight.input.in_parts = Footprint::surface;
    display.run(3000);
    tight.run(3000);
    EXPECT_EQ(display.frames.back().choice.footprint, Footprint::surface) << "within the budget";
    EXPECT_EQ(tight.at(Footprint::quad), 3000);
    EXPECT_TRUE(tight.frames.back().choice.final);
    // What the parts took tells whether moving frames can have it, too.
    SimulatedDisplay cheap(kBudget, constant({2, 30, 5}));
    cheap.controller.measured(Footprint::quad, cheap.input.load, Milliseconds(2));
    cheap.controller.measured_in_parts(Footprint::surface, cheap.input.load, Milliseconds(6));
    cheap.input.pace = Pace::moving;
    EXPECT_EQ(cheap.run(40).choice.footprint, Footprint::surface);
    EXPECT_EQ(cheap.over_budget(), 0);
}

TEST_F(QualityInMotion, WhatIsGuessedTooDearIsDrawnInPartsAndThenAtOnceAsItIsKnownToFit) {
    for (const Pace pace : {Pace::settled, Pace::moving}) {
        SimulatedDisplay display(kBudget, constant({3, 30, 5})); // guesses: 24 and 36
        display.draws_ahead = true;
        display.still = false;
        display.input.pace = pace;
        display.input.in_parts = Footprint::surface;
        EXPECT_EQ(display.run(40).choice.footprint, Footprint::surface);
        EXPECT_EQ(display.over_budget(), 0);
        EXPECT_EQ(display.drawn_ahead, 1);
        display.run(5000);
        EXPECT_GE(display.at(Footprint::surface), 5000);
        EXPECT_EQ(display.over_budget(), 0);
    }
}

TEST_F(QualityInMotion, WhatDoesNotFitIsDrawnInPartsOnceInLongAndNeverAtOnce) {
    double surface = 60;
    SimulatedDisplay display(kBudget, [&](Footprint footprint, const DrawLoad& load) {
        return load.cells / 1e4 * (footprint == Footprint::quad ? 3 : surface);
    });
    display.draws_ahead = true;
    display.still = false;
    display.input.in_parts = Footprint::surface;
    display.run(QualityController::kLongestWait);
    EXPECT_EQ(display.at(Footprint::quad), static_cast<int>(QualityController::kLongestWait));
    EXPECT_EQ(display.drawn_ahead, 1);
    for (int i = 0; i < 1000; ++i) {
        display.input.load.cells = uniform(0.9e4, 1.1e4); // no reason for another one
        display.frame();
    }
    EXPECT_LE(display.drawn_ahead, 2);
    EXPECT_EQ(display.over_budget(), 0);
    EXPECT_EQ(display.at(Footprint::surface), 0);
    surface = 5; // as if other programs had ended
    display.input.load.cells = 1e4;
    display.run(QualityController::kLongestWait + 100);
    EXPECT_EQ(display.frames.back().choice.footprint, Footprint::surface);
    EXPECT_EQ(display.over_budget(), 0);
}

TEST_F(QualityInMotion, TheSurfaceIsFoundWhereverItFitsWhicheverIsTheCheaper) {
    for (const auto& [mesh, surface, wanted] :
         {std::tuple{4.0, 20.0, Footprint::quad}, std::tuple{20.0, 4.0, Footprint::surface},
          std::tuple{6.0, 5.0, Footprint::surface}, std::tuple{20.0, 30.0, Footprint::quad}}) {
        SimulatedDisplay display(kBudget, [&](Footprint footprint, const DrawLoad&) {
            return footprint == Footprint::quad      ? 3.0
                   : footprint == Footprint::mesh    ? mesh
                   : footprint == Footprint::surface ? surface
                                                     : 40.0;
        });
        display.input.available.add(Footprint::mesh);
        display.input.in_parts = Footprint::surface;
        display.draws_ahead = true;
        display.still = false;
        EXPECT_EQ(display.run(400).choice.footprint, wanted);
        EXPECT_EQ(display.over_budget(), 0);
        EXPECT_LE(display.drawn_ahead, 2);
    }
}

TEST_F(QualityInMotion, NothingIsTriedThatWouldFreezeThePicture) {
    SimulatedDisplay display(kBudget, [](Footprint footprint, const DrawLoad& load) {
        constexpr std::array kPerCell{1e-4, 8e-4, 12e-4};
        return 0.05 + load.cells * kPerCell[rung(footprint)];
    });
    display.run(200);
    display.input.load.cells = 3.3e6; // 330 ms, 2.6 s, 4 s
    for (const bool moving : {false, true, false}) {
        display.input.pace = moving ? Pace::moving : Pace::settled;
        const std::size_t first = display.frames.size();
        EXPECT_EQ(display.run(20000).choice.footprint, Footprint::quad);
        EXPECT_EQ(display.at(Footprint::quad, first), 20000);
        EXPECT_EQ(display.frames.back().choice.final, !moving) << "a capture is taken all the same";
    }
    SimulatedDisplay fresh(kBudget, display.cost);
    fresh.input.load.cells = 3.3e6;
    fresh.run(20000);
    EXPECT_EQ(fresh.at(Footprint::quad), 20000);
    EXPECT_TRUE(fresh.frames.back().choice.final);
}

TEST_F(QualityInMotion, PaperModeDrawsQuadsInMotionAndSplatsAtRestAndNothingElse) {
    SimulatedDisplay display(kBudget, constant({1, 300, 2}));
    display.input.mode = QualityMode::paper;
    for (int i = 0; i < 400; ++i) {
        display.input.pace = i / 20 % 2 ? Pace::moving : Pace::settled;
        EXPECT_EQ(display.frame().choice.footprint,
                  i / 20 % 2 ? Footprint::quad : Footprint::gaussian);
        EXPECT_EQ(display.frames.back().choice.final, i / 20 % 2 == 0);
    }
}

} // namespace
} // namespace isochron::app
