// Bricks hold their cells' extremes, and the search with them agrees with the definition.
#include "index/scan/bricks.h"

#include "index/scan/scan.h"
#include "index/volume/ordinal.h"
#include "tests/support/simd_targets.h"
#include "tests/support/test_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace isochron::index {
namespace {

/// Ordinals of all values of a series that are numbers, ascending.
std::vector<std::uint64_t> distinct_ordinals(const StepValues& values) {
    std::set<std::uint64_t> all;
    visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
        for (std::size_t t = 0; t < values.steps; ++t)
            for (const T value : values.step<T>(t))
                if (value == value)
                    all.insert(ordinal(value));
    });
    return {all.begin(), all.end()};
}

/// Lossy levels at some of the values, so that ties with thresholds happen.
LevelMap some_levels(const StepValues& values, std::size_t count) {
    const std::vector<std::uint64_t> all = distinct_ordinals(values);
    std::set<std::uint64_t> some;
    for (std::size_t i = 0; i < count && !all.empty(); ++i)
        some.insert(all[(i + 1) * (all.size() - 1) / (count + 1)]);
    return LevelMap::of_thresholds(values.type,
                                   std::vector<std::uint64_t>(some.begin(), some.end()));
}

std::vector<LevelMap> levels_for(const StepValues& values) {
    std::vector<LevelMap> levels;
    for (const std::size_t count : {0u, 5u, 255u})
        levels.push_back(some_levels(values, count));
    const std::vector<std::uint64_t> all = distinct_ordinals(values);
    if (all.size() <= LevelMap::kMaxLevels)
        levels.push_back(LevelMap::of_values(values.type, all));
    if (size_of(values.type) == 1)
        levels.push_back(LevelMap::of_type(values.type));
    return levels;
}

std::vector<double> some_isovalues(const StepValues& values) {
    std::vector<double> isovalues{-1e300, -0.0, 0.3, 1e300, kNaN, kInfinity, -kInfinity};
    const std::vector<double> sorted = sorted_values(values);
    for (const double value : quantiles(sorted, 5))
        isovalues.insert(isovalues.end(), {std::nextafter(value, -kInfinity), value,
                                           std::nextafter(value, kInfinity)});
    if (!sorted.empty())
        isovalues.insert(isovalues.end(), {sorted.front(), sorted.back()});
    return isovalues;
}

/// The ranks of all bricks' extremes, vertex by vertex.
std::vector<std::uint8_t> slow_bricks(const StepValues& values, const LevelMap& levels,
                                      std::size_t step) {
    const auto [nx, ny, nz] = values.grid.vertices;
    const BrickGrid grid(values.grid);
    const auto bricks = grid.bricks();
    std::vector<std::uint8_t> ranks(values.grid.vertex_count()), out(grid.bytes_per_step(), 255);
    std::fill(out.begin() + std::ptrdiff_t(grid.count()), out.end(), std::uint8_t{0});
    levels.ranks({values.first + step * values.stride, ranks.size() * size_of(values.type)}, ranks);
    for (std::uint32_t z = 0, vertex = 0; z < nz; ++z)
        for (std::uint32_t y = 0; y < ny; ++y)
            for (std::uint32_t x = 0; x < nx; ++x, ++vertex) {
                if (std::isnan(scaled_value(values, step, vertex)))
                    continue;
                // A vertex between two bricks belongs to both.
                for (std::uint32_t bz = z ? (z - 1) / 4 : 0; bz <= std::min(z / 4, bricks[2] - 1);
                     ++bz)
                    for (std::uint32_t by = y ? (y - 1) / 4 : 0;
                         by <= std::min(y / 4, bricks[1] - 1); ++by)
                        for (std::uint32_t bx = x ? (x - 1) / 8 : 0;
                             bx <= std::min(x / 8, bricks[0] - 1); ++bx) {
                            const std::size_t brick =
                                (std::size_t{bz} * bricks[1] + by) * bricks[0] + bx;
                            std::uint8_t& low = out[brick];
                            std::uint8_t& high = out[grid.count() + brick];
                            low = std::min(low, ranks[vertex]);
                            high = std::max(high, ranks[vertex]);
                        }
            }
    return out;
}

/// Extremes and search against brute force, at every step, in every kind of code.
void expect_exact(const StepValues& values) {
    const BrickGrid grid(values.grid);
    const std::vector<double> isovalues = some_isovalues(values);
    for (const LevelMap& levels : levels_for(values))
        for (std::uint32_t step = 0; step < values.steps; ++step) {
            const BruteForce oracle(values, step);
            const std::vector<std::uint8_t> expected = slow_bricks(values, levels, step);
            on_every_simd_target([&] {
                // Exactly as many bytes as there are, so that a sanitizer sees a read behind them.
                std::vector<std::uint8_t> bricks(grid.bytes_per_step());
                build_bricks(values, levels, step, bricks);
                ASSERT_EQ(bricks, expected);
                for (const double isovalue : isovalues) {
                    std::vector<CellId> found;
                    search_bricks(values, levels, bricks, {Instant(step), isovalue}, found);
                    std::sort(found.begin(), found.end());
                    ASSERT_EQ(found, std::isfinite(isovalue) ? oracle.active(isovalue)
                                                             : std::vector<CellId>())
                        << "step " << step << ", isovalue " << isovalue << ", " << levels.levels()
                        << " levels";
                    std::vector<CellId> tested;
                    test_bricks(values, levels, bricks, {Instant(step), isovalue}, tested);
                    std::ranges::sort(tested);
                    ASSERT_EQ(tested, found);
                }
            });
        }
}

/// Mostly flat, so that few bricks are candidates and the scan is not used instead.
TestField::Function spots(std::mt19937& random) {
    return [&random, noise = white_noise(random)](double x, double y, double z, double t) {
        const bool spot = std::fmod(x + 3 * y + 5 * z, 23) < 3 && x > 10;
        return spot && random() % 4 == 0 ? 60 * noise(x, y, z, t) : 50.0;
    };
}

TEST(Bricks, FindTheActiveCellsOfEveryTypeAndScaling) {
    std::mt19937 random(test_seed());
    for (const ValueType type : kAllTypes)
        for (const Scaling& scaling : {Scaling{}, Scaling{-0.1, 1e3}}) {
            SCOPED_TRACE(testing::Message() << name_of(type) << ' ' << scaling.slope);
            expect_exact(TestField({43, 14, 11}, 2, type, spots(random), scaling).view());
            expect_exact(
                TestField({19, 9, 6}, 1, type, scaled(turbulence(random), 90, 10), scaling).view());
        }
}

TEST(Bricks, FindTheActiveCellsOfEveryGridSize) {
    std::mt19937 random(test_seed());
    for (const std::uint32_t nx : {2u, 8u, 9u, 10u, 16u, 17u, 64u, 65u, 66u})
        for (const std::uint32_t ny : {2u, 4u, 5u, 6u})
            for (const std::uint32_t nz : {2u, 5u, 9u}) {
                SCOPED_TRACE(testing::Message() << nx << ' ' << ny << ' ' << nz);
                const ValueType type = kAllTypes[(nx + ny + nz) % kAllTypes.size()];
                expect_exact(
                    TestField({nx, ny, nz}, 1, type, scaled(turbulence(random), 90, 0)).view());
            }
}

TEST(Bricks, NeverReportACellWithANanVertexAndKeepTheRest) {
    std::mt19937 random(test_seed());
    for (const ValueType type : {ValueType::f32, ValueType::f64})
        for (const double special : {kNaN, -kNaN, kInfinity, -kInfinity}) {
            const TestField::Function field = turbulence(random);
            const auto planted = [&](double x, double y, double z, double t) {
                // A corner of nothing else, some more here and there.
                return (x < 10 && y < 6) || random() % 60 == 0 ? special : field(x, y, z, t);
            };
            expect_exact(TestField({40, 12, 9}, 2, type, planted).view());
        }
}

TEST(Bricks, ABrickOfNanOnlyIsNoCandidate) {
    const TestField field({9, 5, 5}, 1, ValueType::f32,
                          [](double, double, double, double) { return kNaN; });
    const LevelMap levels = LevelMap::of_thresholds(ValueType::f32, {});
    std::vector<std::uint8_t> bricks(2);
    build_bricks(field.view(), levels, 0, bricks);
    EXPECT_EQ(bricks, (std::vector<std::uint8_t>{255, 0}));
}

TEST(Bricks, AppendBrickByBrickAndAscendingWithinEach) {
    std::mt19937 random(test_seed());
    const TestField field({80, 40, 30}, 1, ValueType::f32, moving_sphere);
    const StepValues values = field.view();
    const LevelMap levels = some_levels(values, 255);
    const BrickGrid grid(values.grid);
    std::vector<std::uint8_t> bricks(grid.bytes_per_step());
    build_bricks(values, levels, 0, bricks);
    std::vector<CellId> found{7};
    search_bricks(values, levels, bricks, {Instant(0), 112.5}, found);
    ASSERT_GT(found.size(), 1000u);
    EXPECT_EQ(found.front(), 7u);
    const auto place = [&](CellId id) {
        const auto [x, y, z] = values.grid.cell_of(id);
        return std::tuple(z / 4, y / 4, x / 8, id);
    };
    for (std::size_t i = 2; i < found.size(); ++i)
        ASSERT_LT(place(found[i - 1]), place(found[i]));
}

TEST(Bricks, TakeLessThanAThousandthOfTheRawSize) {
    Grid grid;
    grid.vertices = {256, 256, 256};
    const double raw = 24.0 * double(grid.cell_count());
    EXPECT_LT(double(BrickGrid(grid).bytes_per_step()) / raw, 0.0007);
    grid.vertices = {61, 50, 60};
    EXPECT_LT(double(BrickGrid(grid).bytes_per_step()) / (24.0 * double(grid.cell_count())), 0.001);
}

} // namespace
} // namespace isochron::index
