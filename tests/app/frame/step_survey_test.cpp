// A survey of a step: its range and its active cells, and the isovalues that are chosen by them.
#include "app/frame/step_survey.h"

#include "tests/support/test_field.h"
#include "tests/support/test_seed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace isochron::app {
namespace {

using index::BruteForce;
using index::TestField;
using index::ValueType;

std::size_t cells(const TestField& field, std::size_t step, double isovalue) {
    return BruteForce(field.view(), step).active(isovalue).size();
}

TEST(StepSurvey, CountsCellsAsASearchFindsThemToWithinABin) {
    std::mt19937 random(test_seed());
    for (const ValueType type : {ValueType::u8, ValueType::i16, ValueType::f32, ValueType::f64}) {
        const TestField field({31, 26, 22}, 2, type,
                              index::scaled(index::turbulence(random), 90, 100),
                              {.slope = -0.5, .intercept = 7});
        const StepSurvey step = survey_of(field.view(), 1, true);
        const BruteForce slowly(field.view(), 1);
        for (std::size_t bin = 2; bin + 2 < StepSurvey::kBins; bin += 3) {
            const auto between = [&](std::size_t a, std::size_t b) {
                return std::minmax({slowly.active(step.middle_of(a)).size(),
                                    slowly.active(step.middle_of(b)).size()});
            };
            // Integers fall on the middle of a bin or beside it.
            const auto [low, high] = between(bin - 2, bin + 2);
            const double slack = 0.25 * static_cast<double>(high) + 12;
            EXPECT_GE(static_cast<double>(step.cells[bin]), static_cast<double>(low) - slack);
            EXPECT_LE(static_cast<double>(step.cells[bin]), static_cast<double>(high) + slack)
                << index::name_of(type) << " bin " << bin;
        }
    }
}

TEST(StepSurvey, LeavesOutWhatIsNoNumber) {
    TestField field({9, 8, 7}, 1, ValueType::f32,
                    [](double x, double, double, double) { return x; });
    const float nothing = std::numeric_limits<float>::quiet_NaN();
    field.at<float>(0, 0) = nothing;
    field.at<float>(0, 5) = std::numeric_limits<float>::infinity();
    const StepSurvey step = survey_of(field.view(), 0, true);
    EXPECT_EQ(step.low, 0);
    EXPECT_EQ(step.high, 8);
    EXPECT_EQ(step.cells_at(8.5), 0u);
    EXPECT_EQ(step.cells_at(1.5), cells(field, 0, 1.5)) << "away from them";
    for (std::size_t i = 0; i < 9 * 8 * 7; ++i)
        field.at<float>(0, i) = nothing;
    const StepSurvey none = survey_of(field.view(), 0, true);
    EXPECT_FALSE(none.has_values());
    EXPECT_FALSE(surface_in(none, 0.5));
    EXPECT_FALSE(further_isovalue(none, 1, {}));
}

TEST(StepSurvey, AConstantStepHasNoSurface) {
    const TestField field({9, 8, 7}, 1, ValueType::f64,
                          [](double, double, double, double) { return 1e3; });
    const StepSurvey step = survey_of(field.view(), 0, true);
    EXPECT_TRUE(step.is_constant());
    EXPECT_FALSE(surface_in(step, 0.95));
    EXPECT_FALSE(further_isovalue(step, 1e3, {}));
}

/// Fields of several shapes: noise, waves, a ball whose values fall off, and values over many decades.
std::vector<TestField::Function> shapes(std::mt19937& random) {
    return {index::moving_sphere, index::scaled(index::turbulence(random), 3e-4, 5e-4),
            [](double x, double y, double z, double) {
                return std::sin(x / 3) + std::sin(y / 4) * std::cos(z / 5);
            },
            [](double x, double y, double z, double) {
                return std::exp(-0.02 *
                                (std::pow(x - 20, 2) + std::pow(y - 20, 2) + std::pow(z - 20, 2)));
            }};
}

TEST(StepSurvey, TheWayOutHasASurface) {
    std::mt19937 random(test_seed());
    for (const auto& shape : shapes(random)) {
        const TestField field({40, 41, 42}, 1, ValueType::f32, shape);
        const StepSurvey step = survey_of(field.view(), 0, true);
        for (const double share : {0.01, 0.5, 0.95, 1.0}) {
            const auto isovalue = surface_in(step, share);
            ASSERT_TRUE(isovalue);
            EXPECT_GT(cells(field, 0, *isovalue), 0u) << share;
        }
    }
}

TEST(StepSurvey, AFurtherSurfaceHasATenthToSixTenthsOfTheFirstOnesCells) {
    std::mt19937 random(test_seed());
    for (const auto& shape : shapes(random)) {
        const TestField field({60, 61, 62}, 1, ValueType::f32, shape);
        const StepSurvey step = survey_of(field.view(), 0, true);
        for (const double share : {0.7, 0.9, 0.95}) {
            const double first = *surface_in(step, share);
            const double of_first = static_cast<double>(cells(field, 0, first));
            const auto further = further_isovalue(step, first, std::vector{first});
            ASSERT_TRUE(further);
            const double part = static_cast<double>(cells(field, 0, *further)) / of_first;
            EXPECT_GE(part, kFewestOfFirst) << share;
            EXPECT_LE(part, kMostOfFirst) << share;
            const auto third = further_isovalue(step, first, std::vector{first, *further});
            ASSERT_TRUE(third);
            EXPECT_GT(std::abs(*third - *further), (step.high - step.low) / 100);
        }
    }
}

TEST(StepSurvey, AFurtherSurfaceOfAFirstThatIsNotInTheStepIsInTheStep) {
    const TestField field({40, 41, 42}, 1, ValueType::f32, index::moving_sphere);
    const StepSurvey step = survey_of(field.view(), 0, true);
    const auto further = further_isovalue(step, 1e6, std::vector{1e6});
    ASSERT_TRUE(further);
    EXPECT_GT(cells(field, 0, *further), 0u);
}

} // namespace
} // namespace isochron::app
