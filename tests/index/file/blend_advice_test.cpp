// What is expected of blends, against series with twice as many steps.
#include "index/file/blend_advice.h"
#include "index/indexing/index_build.h"
#include "tests/support/memory_series.h"
#include "tests/support/test_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace isochron::index {
namespace {

/// What the index of a series says.
/// @param change of what the series says of itself
std::optional<BlendQuality> measured(const TestField& field,
                                     const std::function<void(SeriesInfo&)>& change = {}) {
    const test_support::TestFolder folder;
    MemorySeries series(field.view());
    if (change)
        change(series.info());
    const auto path = folder.path() / "a.isochron";
    BuildOptions options;
    options.tiers = TierSet().with(Tier::bricks);
    build_index(series, path, options);
    const auto file = IndexFile::open(path);
    const auto kept = file->metadata().blends;
    EXPECT_EQ(kept, measure_blends(file->chunks(), file->stats())) << "kept as it is measured";
    return kept;
}

/// A round blob at a place. @param width of its bell
double bell(double dx, double dy, double dz, double width) {
    return 100 * std::exp(-(dx * dx + dy * dy + dz * dz) / (2 * width * width));
}

/// Moves by so much from step to step.
using Family = std::function<TestField::Function(double by)>;

Family blob(double width) {
    return [=](double by) {
        return [=](double x, double y, double z, double t) {
            return bell(x - 24 - by * (t - 3), y - 16, z - 16, width);
        };
    };
}
/// A small one that is as fast as it is said, beside a large one that stands nearly still.
Family small_beside_large() {
    return [](double by) {
        return [=](double x, double y, double z, double t) {
            return bell(x - 36 - 0.1 * t, y - 16, z - 20, 7) +
                   bell(x - 8, y - 12 - by * (t - 3), z - 8, 3);
        };
    };
}
/// Waves 12 voxels long.
Family waves() {
    return [](double by) {
        return [=](double x, double y, double, double t) {
            return 50 + 50 * std::sin((x + 0.3 * y - by * t) * std::numbers::pi / 6);
        };
    };
}
/// A cigar that turns about its middle; its ends move by so much.
Family cigar() {
    return [](double by) {
        return [=](double x, double y, double z, double t) {
            const double angle = by / 14 * t;
            const double along = std::cos(angle) * (x - 24) + std::sin(angle) * (y - 16),
                         across = -std::sin(angle) * (x - 24) + std::cos(angle) * (y - 16);
            return bell(along / 3, across, z - 16, 3.5);
        };
    };
}
/// A sharp front that a source sends out.
Family front() {
    return [](double by) {
        return [=](double x, double y, double z, double t) {
            const double radius = 12 + by * (t - 3);
            return 50 - 50 * std::tanh((std::hypot(x - 24, y - 16, z - 16) - radius) / 1.5);
        };
    };
}

constexpr std::size_t kSteps = 7;

TestField field_of(const TestField::Function& values, bool finer) {
    return {
        {48, 32, 32},
        finer ? 2 * kSteps - 1 : kSteps,
        ValueType::f32,
        [&](double x, double y, double z, double t) { return values(x, y, z, finer ? t / 2 : t); }};
}

/// Whether the blend of two given steps is too far from the step in the middle of them.
struct Truth {
    double off;
    std::uint64_t lone;
    bool holds() const { return off > 1.0 || lone > 0; }
};
Truth truth_of(const TestField::Function& values) {
    const auto finer = measured(field_of(values, true));
    EXPECT_TRUE(finer);
    return finer ? Truth{finer->every_second, finer->lone_second} : Truth{};
}

TEST(BlendAdvice, IsRightForFortySeriesWhoseFinerStepsAreKnown) {
    const std::vector<std::pair<std::string, std::pair<Family, std::vector<double>>>> series{
        {"blob 5", {blob(5), {0.5, 1, 2, 3, 5, 6, 7, 8}}},
        {"blob 8", {blob(8), {0.5, 1, 2, 3, 5, 8, 9, 10}}},
        {"small beside large", {small_beside_large(), {0.3, 0.6, 1, 2, 3, 4}}},
        {"waves", {waves(), {0.25, 0.5, 1, 3, 4, 5}}},
        {"cigar", {cigar(), {0.5, 1, 2, 5, 8, 11}}},
        {"front", {front(), {0.3, 0.6, 1, 4, 5, 6}}},
    };
    const int kEvery = 4 / tries(4);
    int all = 0, right = 0, counted = 0, coarse = 0;
    for (const auto& [name, of] : series)
        for (const double by : of.second) {
            if (all++ % kEvery != 0)
                continue;
            const auto advice = measured(field_of(of.first(by), false));
            ASSERT_TRUE(advice);
            const Truth truth = truth_of(of.first(by));
            const bool sure = truth_of(of.first(by / 1.2)).holds() == truth.holds() &&
                              truth_of(of.first(by * 1.2)).holds() == truth.holds();
            const bool is_right = advice->holds() == truth.holds();
            fmt::print(
                "{}, {} voxels a step: off by {:.2g}, {} lone; expected {:.2g}, {} lone: {}\n",
                name, by, truth.off, truth.lone, advice->expected(), advice->lone,
                !sure      ? "near the threshold"
                : is_right ? "right"
                           : "WRONG");
            if (!sure)
                continue;
            ++counted;
            coarse += truth.holds() ? 1 : 0;
            right += is_right ? 1 : 0;
        }
    EXPECT_EQ(all, 40);
    EXPECT_GE(coarse, counted / (kEvery == 1 ? 3 : 5));
    EXPECT_LE(coarse, 2 * counted / 3);
    EXPECT_GE(counted, 30 / kEvery);
    EXPECT_GE(right, 0.95 * counted) << counted << " are counted";
}

TEST(BlendAdvice, HoldsWhereASmallPartVanishesThoughNearlyAllOfTheSurfaceIsRight) {
    // The speck stays within a chunk in each step that is looked at.
    const auto speck_over_plane = [](double by) {
        return TestField(
            {80, 32, 26}, 7, ValueType::f32, [=](double x, double y, double z, double t) {
                return 100 - 3 * z + 0.42 * bell(x - 40 - by * (t - 3), y - 24, z - 21, 3);
            });
    };
    const auto slow = measured(speck_over_plane(0.4)), fast = measured(speck_over_plane(14));
    ASSERT_TRUE(slow && fast);
    EXPECT_EQ(slow->lone, 0u);
    EXPECT_FALSE(slow->holds());
    EXPECT_GT(fast->lone, 0u);
    EXPECT_LT(fast->expected(), 0.5) << "95 % of the cells are of the plane";
    EXPECT_TRUE(fast->holds());
}

/// A front moves through the borders of chunks: what it becomes in the blend may lie in the next one.
TEST(BlendAdvice, LooksForThePartnersOfFlatFrontsInTheNextChunks) {
    const auto front = [](int axis, double by, double width) {
        std::array<std::uint32_t, 3> size{17, 17, 17};
        size[static_cast<std::size_t>(axis)] = 48;
        return TestField(size, 17, ValueType::f32, [=](double x, double y, double z, double t) {
            return std::tanh((std::array{x, y, z}[static_cast<std::size_t>(axis)] - 8 - by * t) /
                             width);
        });
    };
    for (const int axis : {0, 1, 2})
        for (const double by : {0.7, 1.5}) {
            const auto quality = measured(front(axis, by, 2));
            ASSERT_TRUE(quality);
            EXPECT_EQ(quality->lone, 0u) << "axis " << axis << ", " << by << " voxels a step";
            EXPECT_FALSE(quality->holds());
        }
    // One that is thinner than its way in a step is there twice in the blend.
    const auto thin = measured(front(0, 2.8, 0.4));
    ASSERT_TRUE(thin);
    EXPECT_TRUE(thin->holds());
}

/// Gaps are held whatever the advice is, so it is about the other distances.
TEST(BlendAdvice, LeavesGapsOut) {
    constexpr std::uint32_t kGap = 5, kMissing = 20;
    const auto jumped = [](double t) { return t > kGap ? t + kMissing : t; };
    const auto smooth = blob(8)(0.5);
    const TestField field(
        {48, 32, 32}, 12, ValueType::f32,
        [&](double x, double y, double z, double t) { return smooth(x, y, z, jumped(t)); });
    const auto unknown = measured(field);
    const auto missing = measured(field, [](SeriesInfo& info) { info.missing_after = {kGap}; });
    const auto timed = measured(field, [&](SeriesInfo& info) {
        for (std::size_t t = 0; t < info.times.size(); ++t)
            info.times[t] = jumped(static_cast<double>(t));
    });
    ASSERT_TRUE(unknown && missing && timed);
    EXPECT_GT(unknown->expected(), 0.5) << "the gap is blended, too";
    for (const auto& advice : {missing, timed}) {
        EXPECT_FALSE(advice->holds());
        EXPECT_LT(advice->expected(), 0.1);
    }
}

TEST(BlendAdvice, HoldsWhatIsNewInEveryStep) {
    std::mt19937 random(test_seed());
    const TestField field({40, 40, 40}, 7, ValueType::u8, scaled(white_noise(random), 100, 120));
    const auto quality = measured(field);
    ASSERT_TRUE(quality);
    EXPECT_FALSE(quality->expected() < 0.25 * quality->every_second);
}

TEST(BlendAdvice, SaysNothingOfTwoStepsOrOfConstantValues) {
    EXPECT_FALSE(measured(TestField({20, 20, 20}, 2, ValueType::f32, blob(5)(1))));
    EXPECT_FALSE(measured(TestField({20, 20, 20}, 6, ValueType::f32,
                                    [](double, double, double, double) { return 3.0; })));
}

} // namespace
} // namespace isochron::index
