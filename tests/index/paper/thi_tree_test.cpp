// A search in the THI tree with the exact test finds what brute force finds, on every kind of data.
#include "index/paper/thi_tree.h"

#include "index/scan/scan.h"
#include "tests/support/paths.h"
#include "tests/support/test_field.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace isochron::index {
namespace {

std::vector<CellId> sorted(std::vector<CellId> ids) {
    std::sort(ids.begin(), ids.end());
    return ids;
}

/// Candidates once each, all active cells among them, and after the exact test these alone.
void expect_exact(const ThiTree& tree, const StepValues& values,
                  const std::vector<double>& isovalues) {
    const KeyMap keys(values.type, values.scaling);
    for (std::uint32_t step = 0; step < values.steps; ++step) {
        const BruteForce oracle(values, step);
        for (const double isovalue : isovalues) {
            std::vector<CellId> found;
            tree.search(step, keys.threshold(isovalue), found);
            found = sorted(std::move(found));
            ASSERT_EQ(std::adjacent_find(found.begin(), found.end()), found.end())
                << "a cell twice at step " << step << ", isovalue " << isovalue;
            keep_active(values, {Instant(step), isovalue}, found);
            ASSERT_EQ(found, oracle.active(isovalue))
                << "at step " << step << ", isovalue " << isovalue;
        }
    }
}

void expect_exact(const StepValues& values, const ThiOptions& options,
                  const std::vector<double>& isovalues) {
    SCOPED_TRACE(testing::Message()
                 << "L " << options.lattice << ", MaxVariation " << options.max_variation);
    const std::vector<std::byte> bytes = build_thi_tree(values, options);
    expect_exact(ThiTree(bytes), values, isovalues);
}

const std::array kOptions{ThiOptions{1, 1},  ThiOptions{2, 1},    ThiOptions{2, 3},
                          ThiOptions{32, 1}, ThiOptions{32, 2},   ThiOptions{128, 3},
                          ThiOptions{64, 2}, ThiOptions{4096, 1}, ThiOptions{4096, 64}};

/// Isovalues of long series.
const int kIsovalues = tries(64);

TEST(ThiTree, FindsTheActiveCellsOfTheMovingSphere) {
    for (const ValueType type : {ValueType::f32, ValueType::u8}) {
        SCOPED_TRACE(name_of(type));
        const TestField field({61, 50, 60}, 55, type, moving_sphere);
        expect_exact(field.view(), {64, 2}, quantiles(sorted_values(field.view()), kIsovalues));
    }
}

/// All bytes of a gzipped file.
std::vector<char> unzipped(const std::string& path) {
    std::vector<char> bytes(std::size_t{64} << 20);
    const gzFile file = gzopen(path.c_str(), "rb");
    const int size = file ? gzread(file, bytes.data(), static_cast<unsigned>(bytes.size())) : 0;
    if (file)
        gzclose(file);
    bytes.resize(static_cast<std::size_t>(std::max(size, 0)));
    return bytes;
}

TEST(ThiTree, FindsTheActiveCellsOfAnFmriSeries) {
    const std::vector<char> bytes =
        unzipped(test_support::test_data() + "/fmri/filtered_func_data.nii.gz");
    ASSERT_GT(bytes.size(), 352u);
    const auto read = [&]<class T>(std::size_t offset, T number) {
        std::memcpy(&number, bytes.data() + offset, sizeof number);
        return number;
    };
    // The NIfTI-1 header: dimensions, type, offset of the values, scaling.
    std::array<std::uint32_t, 4> dims;
    for (std::size_t axis = 0; axis < 4; ++axis)
        dims[axis] = static_cast<std::uint32_t>(read(42 + 2 * axis, std::int16_t{}));
    ASSERT_EQ(read(70, std::int16_t{}), 4) << "i16";
    const auto offset = static_cast<std::size_t>(read(108, float{}));
    const Scaling scaling{read(112, float{}) != 0 ? read(112, float{}) : 1.0, read(116, float{})};
    const std::size_t vertices = std::size_t{dims[0]} * dims[1] * dims[2];
    ASSERT_EQ(bytes.size(), offset + vertices * dims[3] * 2);
    TestField field(
        {dims[0], dims[1], dims[2]}, dims[3], ValueType::i16,
        [](double, double, double, double) { return 0.0; }, scaling);
    for (std::size_t step = 0; step < dims[3]; ++step)
        std::memcpy(&field.at<std::int16_t>(step, 0), bytes.data() + offset + step * vertices * 2,
                    vertices * 2);
    expect_exact(field.view(), {64, 2}, quantiles(sorted_values(field.view()), kIsovalues));
}

TEST(ThiTree, FindsTheActiveCellsOfTurbulence) {
    std::mt19937 random(test_seed());
    const TestField field({20, 17, 18}, 21, ValueType::f32, turbulence(random));
    const std::vector<double> isovalues = quantiles(sorted_values(field.view()), kIsovalues);
    for (const ThiOptions& options : kOptions)
        expect_exact(field.view(), options, isovalues);
}

TEST(ThiTree, FindsTheActiveCellsOfWhiteNoise) {
    std::mt19937 random(test_seed());
    const TestField field({9, 11, 10}, 8, ValueType::f32, white_noise(random));
    const std::vector<double> isovalues = quantiles(sorted_values(field.view()), kIsovalues);
    for (const ThiOptions& options : kOptions)
        expect_exact(field.view(), options, isovalues);
}

TEST(ThiTree, FindsTheActiveCellsOfEveryTypeAndScalingAtTies) {
    std::mt19937 random(test_seed());
    for (const ValueType type : kAllTypes)
        for (const Scaling& scaling : {Scaling{}, Scaling{-1, 0}, Scaling{0.1, 1e6},
                                       Scaling{-1e-9, 1.0}, Scaling{1e30, -7}}) {
            SCOPED_TRACE(testing::Message() << name_of(type) << ' ' << scaling.slope);
            const TestField field({5, 6, 4}, 5, type, index::scaled(turbulence(random), 200, 20),
                                  scaling);
            for (const ThiOptions& options : {ThiOptions{32, 2}, ThiOptions{4096, 1}})
                expect_exact(field.view(), options, ties(field.view(), 60));
        }
}

TEST(ThiTree, HoldsForAnyNumberOfStepsIncludingPrimes) {
    std::mt19937 random(test_seed());
    for (const std::size_t steps : {1, 2, 3, 4, 5, 7, 10, 13, 16, 31}) {
        SCOPED_TRACE(steps);
        const TestField field({7, 6, 5}, steps, ValueType::i16,
                              index::scaled(turbulence(random), 40, 0));
        for (const ThiOptions& options : kOptions)
            expect_exact(field.view(), options, ties(field.view(), 12));
    }
}

TEST(ThiTree, HoldsForGridsOfOneCellAcross) {
    std::mt19937 random(test_seed());
    for (const std::array<std::uint32_t, 3> vertices :
         {std::array{2u, 2u, 2u}, {9u, 2u, 2u}, {2u, 9u, 2u}, {2u, 2u, 9u}, {2u, 7u, 8u}}) {
        const TestField field(vertices, 6, ValueType::i16,
                              index::scaled(turbulence(random), 30, 0));
        for (const ThiOptions& options : kOptions)
            expect_exact(field.view(), options, ties(field.view(), 60));
    }
}

TEST(ThiTree, LeavesOutCellsWithANanVertexWhileTheyHaveIt) {
    std::mt19937 random(test_seed());
    for (const ValueType type : {ValueType::f32, ValueType::f64})
        for (const double special : {kNaN, -kNaN, kInfinity, -kInfinity}) {
            const TestField::Function smooth = turbulence(random);
            const TestField field({9, 8, 7}, 9, type, [&](double x, double y, double z, double t) {
                return random() % 60 == 0 ? special : smooth(x, y, z, t);
            });
            for (const ThiOptions& options : kOptions)
                expect_exact(field.view(), options, ties(field.view(), 12));
        }
}

TEST(ThiTree, HoldsForTheLimitsOfTheTypes) {
    for (const ValueType type : kAllTypes)
        visit_value_type(type, [&]<class T>(std::type_identity<T>) {
            using Limits = std::numeric_limits<T>;
            TestField field({4, 4, 4}, 3, type,
                            [](double x, double, double, double t) { return x + t; });
            field.at<T>(1, 20) = Limits::max();
            field.at<T>(2, 41) = Limits::lowest();
            if constexpr (std::is_floating_point_v<T>) {
                field.at<T>(0, 5) = Limits::denorm_min();
                field.at<T>(0, 6) = T{-0.0};
            }
            for (const ThiOptions& options : kOptions)
                expect_exact(field.view(), options, ties(field.view(), 60));
        });
}

TEST(ThiTree, StoresNothingForFieldsThatNeverHaveAnActiveCell) {
    for (const double value : {kNaN, 0.0, -0.0, kInfinity, 7.0})
        for (const ThiOptions& options : kOptions) {
            // Constant in space, different from step to step.
            const TestField field({5, 4, 6}, 7, ValueType::f32,
                                  [&](double, double, double, double t) { return value + t; });
            const auto bytes = build_thi_tree(field.view(), options);
            EXPECT_EQ(ThiTree(bytes).entries(), 0u);
            expect_exact(ThiTree(bytes), field.view(), {-7, 0, 7, 8, 1e300});
        }
}

TEST(ThiTree, SearchesIncrementallyFromAnyStepToAnyOther) {
    std::mt19937 random(test_seed());
    for (const std::uint32_t steps : {1u, 2u, 5u, 8u, 13u, 55u}) {
        const TestField field({12, 11, 10}, steps, ValueType::f32, turbulence(random));
        const auto bytes = build_thi_tree(field.view(), {64, 2});
        const ThiTree tree(bytes);
        const KeyMap keys(ValueType::f32, {});
        ThiTree::Cursor cursor;
        double isovalue = 0;
        for (int jump = 0; jump < 300; ++jump) {
            if (random() % 10 == 0)
                isovalue = std::uniform_real_distribution<double>(-1, 1)(random);
            const std::uint64_t threshold = keys.threshold(isovalue);
            std::uint32_t step = static_cast<std::uint32_t>(random()) % steps;
            if (random() % 2) // playback, either way, around the end
                step = (cursor.step + (random() % 2 ? 1 : steps - 1)) % steps;
            const bool same = cursor.valid && cursor.threshold == threshold;
            const bool stayed = same && cursor.step == step;
            const std::size_t reused = tree.search_incremental(cursor, step, threshold);
            std::vector<CellId> full;
            tree.search(step, threshold, full);
            ASSERT_EQ(cursor.cells, full) << "seed above, jump " << jump;
            ASSERT_EQ(cursor.reached.back(), cursor.cells.size());
            ASSERT_TRUE(same || reused == 0);
            ASSERT_TRUE(!stayed || reused == full.size());
        }
    }
}

TEST(ThiTree, ReusesWhatTheLowestCommonNodeAndThoseAboveFound) {
    // One cell without change, and one that changes all the time.
    const TestField field({4, 2, 2}, 4, ValueType::u8, [](double x, double, double, double t) {
        return x < 2 ? 10 * x : 50 + 40 * t + x;
    });
    const auto bytes = build_thi_tree(field.view(), {4096, 1});
    const ThiTree tree(bytes);
    ThiTree::Cursor cursor;
    const std::uint64_t threshold = KeyMap(ValueType::u8, {}).threshold(5);
    EXPECT_EQ(tree.search_incremental(cursor, 0, threshold), 0u);
    EXPECT_EQ(cursor.cells, (std::vector<CellId>{0}));
    EXPECT_EQ(cursor.reached, (std::vector<std::size_t>{1, 1, 1}));
    EXPECT_EQ(tree.search_incremental(cursor, 3, threshold), 1u);
}

TEST(ThiTree, KnowsItsOptionsStepsAndEntries) {
    std::mt19937 random(test_seed());
    const TestField field({9, 8, 7}, 11, ValueType::f32, turbulence(random));
    const auto bytes = build_thi_tree(field.view(), {32, 3});
    const ThiTree tree(bytes);
    EXPECT_EQ(bytes.size() % 8, 0u);
    EXPECT_EQ(tree.options(), (ThiOptions{32, 3}));
    EXPECT_EQ(tree.steps(), 11u);
    std::uint64_t cells = 0;
    for (const TimeNodeCells& node : tree.nodes())
        cells += node.cells;
    EXPECT_EQ(cells, tree.entries());
    EXPECT_LE(cells, 11 * field.view().grid.cell_count());
    EXPECT_GT(cells, 0u);
}

TEST(ThiTree, ShrinksWithMaxVariationAndWithLargerElements) {
    const TestField field({31, 25, 30}, 16, ValueType::f32, moving_sphere);
    const auto entries = [&](ThiOptions options) {
        const auto bytes = build_thi_tree(field.view(), options);
        return ThiTree(bytes).entries();
    };
    EXPECT_GT(entries({64, 1}), entries({64, 2}));
    EXPECT_GT(entries({64, 2}), entries({64, 3}));
    EXPECT_LT(entries({32, 2}), entries({64, 2}));
    EXPECT_LT(entries({64, 2}), entries({128, 2}));
}

} // namespace
} // namespace isochron::index
