// The scan and the exact test agree with brute force on every kind of data.
#include "index/scan/scan.h"

#include "tests/support/simd_targets.h"
#include "tests/support/test_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace isochron::index {
namespace {

/// Both functions against brute force, at every step and isovalue, in every kind of code.
void expect_exact(const StepValues& values, const std::vector<double>& isovalues) {
    std::vector<CellId> all(values.grid.cell_count());
    std::iota(all.begin(), all.end(), CellId{0});
    for (std::uint32_t step = 0; step < values.steps; ++step) {
        const BruteForce oracle(values, step);
        for (const double isovalue : isovalues) {
            const std::vector<CellId> expected = oracle.active(isovalue);
            on_every_simd_target([&] {
                std::vector<CellId> found, kept = all;
                scan(values, {Instant(step), isovalue}, found);
                keep_active(values, {Instant(step), isovalue}, kept);
                ASSERT_EQ(found, expected) << "scan at step " << step << ", isovalue " << isovalue;
                ASSERT_EQ(kept, expected)
                    << "keep_active at step " << step << ", isovalue " << isovalue;
            });
        }
    }
}

TEST(Scan, FindsTheActiveCellsOfEveryTypeAndScalingAtTies) {
    std::mt19937 random(test_seed());
    for (const ValueType type : kAllTypes)
        for (const Scaling& scaling : kScalings) {
            SCOPED_TRACE(testing::Message() << name_of(type) << ' ' << scaling.slope);
            const TestField field({5, 6, 4}, 2, type, index::scaled(white_noise(random), 100, 0),
                                  scaling);
            expect_exact(field.view(), ties(field.view()));
        }
}

TEST(Scan, FindsTheActiveCellsOfEveryRowLength) {
    std::mt19937 random(test_seed());
    for (const std::uint32_t nx : {2u, 3u, 63u, 64u, 65u, 66u, 127u, 128u, 129u, 130u, 200u})
        for (const ValueType type : {ValueType::u8, ValueType::f32}) {
            SCOPED_TRACE(testing::Message() << nx << ' ' << name_of(type));
            const TestField field({nx, 3, 2}, 1, type, index::scaled(white_noise(random), 10, 10));
            expect_exact(field.view(), {0, 1, 3.5, 10, 17, 20});
        }
}

TEST(Scan, FindsTheActiveCellsOfGridsOfOneCellAcross) {
    std::mt19937 random(test_seed());
    for (const std::array<std::uint32_t, 3> vertices :
         {std::array{2u, 2u, 2u}, {9u, 2u, 2u}, {2u, 9u, 2u}, {2u, 2u, 9u}, {2u, 7u, 8u}}) {
        const TestField field(vertices, 3, ValueType::i16,
                              index::scaled(white_noise(random), 5, 0));
        expect_exact(field.view(), ties(field.view()));
    }
}

TEST(Scan, NeverReportsACellWithANanVertex) {
    std::mt19937 random(test_seed());
    for (const ValueType type : {ValueType::f32, ValueType::f64})
        for (const double special : {kNaN, -kNaN, kInfinity, -kInfinity}) {
            const TestField::Function noise = white_noise(random);
            const TestField field({70, 8, 9}, 3, type, [&](double x, double y, double z, double t) {
                return random() % 40 == 0 ? special : noise(x, y, z, t);
            });
            expect_exact(field.view(), {-2, -0.5, 0, 0.25, 0.99, 2});
        }
}

TEST(Scan, AgreesOnFieldsOfNanOnlyAndOnConstantFields) {
    for (const double value : {kNaN, 0.0, -0.0, kInfinity, 7.0}) {
        const TestField field({5, 5, 5}, 1, ValueType::f32,
                              [&](double, double, double, double) { return value; });
        expect_exact(field.view(), {-7, 0, 7, 1e300});
    }
}

TEST(Scan, TakesBothZerosForOneValue) {
    const TestField field({9, 3, 3}, 1, ValueType::f32,
                          [](double x, double, double, double) { return int(x) % 2 ? 0.0 : -0.0; });
    expect_exact(field.view(), {0, std::numeric_limits<double>::denorm_min(), -1});
}

TEST(Scan, FindsNothingAtAnIsovalueThatIsNotFinite) {
    std::mt19937 random(test_seed());
    const TestField::Function noise = white_noise(random);
    const TestField field({5, 5, 5}, 1, ValueType::f32,
                          [&](double x, double y, double z, double t) {
                              return random() % 8 ? noise(x, y, z, t) : kInfinity;
                          });
    for (const double isovalue : {kNaN, kInfinity, -kInfinity}) {
        std::vector<CellId> found, kept{0, 1, 2};
        scan(field.view(), {Instant(0), isovalue}, found);
        keep_active(field.view(), {Instant(0), isovalue}, kept);
        EXPECT_TRUE(found.empty());
        EXPECT_TRUE(kept.empty());
    }
}

TEST(Scan, AppendsToWhatIsThere) {
    std::mt19937 random(test_seed());
    const TestField field({5, 5, 5}, 1, ValueType::f32, white_noise(random));
    std::vector<CellId> found{99};
    scan(field.view(), {Instant(0), 0}, found);
    EXPECT_EQ(found.front(), 99u);
    EXPECT_GT(found.size(), 1u);
}

TEST(KeepActive, KeepsIdsOfAnyOrderAndNumber) {
    std::mt19937 random(test_seed());
    const TestField field({150, 5, 4}, 1, ValueType::f32, white_noise(random));
    const std::vector<CellId> active = BruteForce(field.view(), 0).active(0.9);
    std::vector<CellId> ids(5000), expected;
    for (CellId& id : ids)
        id = static_cast<CellId>(random() % field.view().grid.cell_count());
    for (const CellId id : ids)
        if (std::binary_search(active.begin(), active.end(), id))
            expected.push_back(id);
    keep_active(field.view(), {Instant(0), 0.9}, ids);
    EXPECT_EQ(ids, expected);
}

TEST(KeepActive, DropsIdsThatAreNoCellsAndKeepsTheOrder) {
    const TestField field({4, 4, 4}, 1, ValueType::u8,
                          [](double x, double, double, double) { return x; });
    std::vector<CellId> ids{26, 3, 0, 27, 0xffffffff, 9};
    keep_active(field.view(), {Instant(0), 1}, ids);
    EXPECT_EQ(ids, (std::vector<CellId>{3, 0, 9}));
}

TEST(Scan, FindsTheActiveCellsOfTheMovingSphere) {
    for (const ValueType type : {ValueType::f32, ValueType::u8}) {
        const TestField field({61, 50, 60}, 1, type, moving_sphere);
        const std::vector<double> sorted = sorted_values(field.view());
        expect_exact(field.view(), quantiles(sorted, 24));
    }
}

} // namespace
} // namespace isochron::index
