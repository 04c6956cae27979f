// Helpers for tests of the quality controller: costs of three footprints, and a check for flicker.
#pragma once

#include "tests/app/frame/simulated_display.h"

#include "tests/support/test_seed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <random>

namespace isochron::app {

using interaction::Pace;
using interaction::QualityMode;
using render::Footprint;

inline constexpr double kBudget = 10; // ms
using Costs = std::array<double, 3>;  ///< costs of quads, splats and surfaces

inline std::size_t rung(Footprint footprint) {
    return std::min<std::size_t>(static_cast<std::size_t>(footprint), 2);
}

/// Each footprint at its own cost, whatever the load.
inline SimulatedDisplay::Cost constant(Costs costs) {
    return [costs](Footprint footprint, const DrawLoad&) { return costs[rung(footprint)]; };
}

inline Footprint best_that_fits(const Costs& costs) {
    for (const Footprint footprint : {Footprint::surface, Footprint::gaussian})
        if (costs[rung(footprint)] <= kBudget)
            return footprint;
    return Footprint::quad;
}

class QualityControllerTest : public testing::Test {
  protected:
    double uniform(double low, double high) {
        return std::uniform_real_distribution<>(low, high)(random_);
    }
    bool chance(double probability) { return uniform(0, 1) < probability; }
    Costs random_costs() { return {uniform(0, 12), uniform(0, 20), uniform(0, 20)}; }

    std::mt19937 random_{test_seed()};
};

/// Every step up is at least the shortest wait after the last step down, while the pace stays.
inline void expect_no_flicker(const SimulatedDisplay& display, std::size_t first = 1) {
    std::optional<std::size_t> down;
    for (std::size_t i = std::max<std::size_t>(first, 1); i < display.frames.size(); ++i) {
        const Footprint before = display.frames[i - 1].choice.footprint;
        const Footprint now = display.frames[i].choice.footprint;
        if (now < before)
            down = i;
        if (now > before && down) {
            EXPECT_GE(i - *down, QualityController::kShortestWait) << "at frame " << i;
        }
    }
}

} // namespace isochron::app
