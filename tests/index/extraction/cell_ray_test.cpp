// Picking: the first place where a ray meets a surface, compared with a test of every cell.
#include "index/extraction/cell_ray.h"

#include "index/indexing/index_build.h"
#include "index/volume/sample.h"
#include "tests/support/memory_series.h"
#include "tests/support/test_field.h"
#include "tests/support/test_folder.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochron::index {
namespace {

using test_support::TestFolder;

double uniform(std::mt19937& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

glm::dvec3 random_direction(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

/// Turned, stretched and away from the origin.
Grid odd_grid(Grid grid, std::mt19937& random) {
    grid.origin = {-40.0, 1000.0, 3.5};
    grid.spacing = {0.7, 2.5, 1.3};
    grid.direction =
        glm::dmat3(glm::mat3_cast(glm::angleAxis(uniform(random, 0, 3), random_direction(random))));
    return grid;
}

ExtractionPtr extracted(const StepValues& values, const SurfacesQuery& query) {
    const TestFolder folder;
    MemorySeries series(values);
    build_index(series, folder.path() / "a.isochron", {});
    return extract_from(IndexFile::open(folder.path() / "a.isochron"))(query, {});
}

glm::dvec3 in_grid(const Grid& grid, const glm::dvec3& index) {
    return glm::dvec3(grid.physical_from_index() * glm::dvec4(index, 1.0));
}

/// Every active cell, sampled finely along the ray's stretch in it.
struct Oracle {
    explicit Oracle(const StepValues& v, std::uint32_t at) : values(v), step(at), cells(v, at) {}

    double value(const std::array<std::uint32_t, 3>& cell, const glm::dvec3& local) const {
        const auto [nx, ny, nz] = values.grid.vertices;
        double sum = 0;
        for (std::size_t c = 0; c < 8; ++c) {
            const std::size_t x = c & 1, y = c >> 1 & 1, z = c >> 2;
            sum +=
                scaled_value(values, step, ((cell[2] + z) * ny + cell[1] + y) * nx + cell[0] + x) *
                (x ? local.x : 1 - local.x) * (y ? local.y : 1 - local.y) *
                (z ? local.z : 1 - local.z);
        }
        return sum;
    }
    std::optional<double> first(const Ray& ray, double isovalue) const {
        constexpr int kSamples = 400;
        const glm::dmat4 to_index = glm::inverse(values.grid.physical_from_index());
        const glm::dvec3 origin(to_index * glm::dvec4(ray.origin, 1));
        const glm::dvec3 direction(to_index * glm::dvec4(ray.direction, 0));
        std::optional<double> nearest;
        for (const CellId id : cells.active(isovalue)) {
            const auto cell = values.grid.cell_of(id);
            const glm::dvec3 low(cell[0], cell[1], cell[2]);
            double from = 0, to = std::numeric_limits<double>::infinity();
            for (int axis = 0; axis < 3; ++axis) {
                const double a = (low[axis] - origin[axis]) / direction[axis];
                const double b = (low[axis] + 1 - origin[axis]) / direction[axis];
                from = std::max(from, std::min(a, b));
                to = std::min(to, std::max(a, b));
            }
            if (!(from < to) || (nearest && from >= *nearest))
                continue;
            const auto at = [&](double t) {
                return value(cell, origin + t * direction - low) - isovalue;
            };
            double before = from;
            for (int i = 1; i <= kSamples; ++i) {
                double after = std::lerp(from, to, double(i) / kSamples);
                if ((at(before) >= 0) == (at(after) >= 0)) {
                    before = after;
                    continue;
                }
                const bool above = at(before) >= 0;
                for (int halving = 0; halving < 60; ++halving) {
                    const double middle = 0.5 * (before + after);
                    ((at(middle) >= 0) == above ? before : after) = middle;
                }
                if (!nearest || after < *nearest)
                    nearest = after;
                break;
            }
        }
        return nearest;
    }

    StepValues values;
    std::uint32_t step;
    BruteForce cells;
};

class CellRayTest : public testing::Test {
  protected:
    /// From anywhere, inside too, towards a place in the volume.
    Ray random_ray(const Grid& grid) {
        const auto cells = grid.cells();
        const auto place = [&](double beyond) {
            return in_grid(grid, {uniform(random_, -beyond, cells[0] + beyond),
                                  uniform(random_, -beyond, cells[1] + beyond),
                                  uniform(random_, -beyond, cells[2] + beyond)});
        };
        const glm::dvec3 from = place(15), to = place(0);
        return {from, uniform(random_, 0.5, 2) * glm::normalize(to - from)};
    }

    /// @param tolerance voxels, of the smallest spacing
    void expect_hits(const StepValues& values, const std::vector<double>& isovalues,
                     double tolerance, double grazing) {
        const std::uint32_t step = 1;
        const ExtractionPtr shown = extracted(values, {Instant(step), isovalues});
        ASSERT_TRUE(shown);
        const Oracle oracle(values, step);
        int hits = 0, misses = 0, different = 0;
        constexpr int kRays = 300;
        for (int i = 0; i < kRays; ++i) {
            const Ray ray = random_ray(values.grid);
            std::optional<double> expected;
            std::size_t surface = 0;
            for (std::size_t s = 0; s < isovalues.size(); ++s)
                if (const auto t = oracle.first(ray, isovalues[s]);
                    t && (!expected || *t < *expected)) {
                    expected = t;
                    surface = s;
                }
            const auto hit = first_hit(*shown, values.grid, ray);
            const double length = glm::length(ray.direction);
            if (hit.has_value() != expected.has_value() ||
                (hit && std::abs(hit->along - *expected) * length > tolerance)) {
                ++different;
                continue;
            }
            ++(hit ? hits : misses);
            if (!hit)
                continue;
            EXPECT_EQ(hit->surface, surface);
            EXPECT_LT(glm::distance(hit->at, ray.origin + hit->along * ray.direction), 1e-9);
            const auto value = value_at(values, step, hit->at);
            ASSERT_TRUE(value);
            EXPECT_NEAR(*value, isovalues[surface], grazing);
        }
        // The oracle misses two crossings between two of its samples.
        EXPECT_LE(different, kRays / 100);
        EXPECT_GT(hits, kRays / 4);
        EXPECT_GT(misses, 0);
    }

    std::mt19937 random_{test_seed()};
};

TEST_F(CellRayTest, HitsWhatEveryCellLookedAtHitsInSmoothDataOfAnyType) {
    for (const ValueType type : {ValueType::u8, ValueType::i16, ValueType::f32, ValueType::f64}) {
        SCOPED_TRACE(name_of(type));
        TestField field({19, 23, 14}, 2, type, scaled(turbulence(random_), 100, 110));
        StepValues values = field.view();
        values.grid = odd_grid(values.grid, random_);
        // f64 is held as f32 in the bricks: rounded by 2^-24 of the range.
        expect_hits(values, {150.0, 90.25}, 1e-3, 1e-3);
    }
}

TEST_F(CellRayTest, HitsWhatEveryCellLookedAtHitsInNoiseWithCellsThatAreNotNumbers) {
    TestField field({12, 9, 17}, 2, ValueType::f32, white_noise(random_));
    for (int i = 0; i < 60; ++i)
        field.at<float>(1, random_() % (12 * 9 * 17)) = std::numeric_limits<float>::quiet_NaN();
    StepValues values = field.view();
    values.grid = odd_grid(values.grid, random_);
    expect_hits(values, {0.3}, 1e-4, 1e-4);
}

TEST_F(CellRayTest, GoesAlongAxesAndOnCellBordersAndStartsInside) {
    // The plane x = 5.25.
    const TestField field({12, 6, 6}, 1, ValueType::f32,
                          [](double x, double, double, double) { return x; });
    const StepValues values = field.view();
    const ExtractionPtr shown = extracted(values, {Instant(0), {5.25}});
    for (const double y : {0.0, 2.0, 2.5, 5.0})
        for (const double from : {-3.0, 0.0, 4.0, 5.2}) {
            const auto hit = first_hit(*shown, values.grid, {{from, y, 3.0}, {2.0, 0.0, 0.0}});
            ASSERT_TRUE(hit) << from << " " << y;
            EXPECT_NEAR(hit->at.x, 5.25, 1e-6);
            EXPECT_NEAR(hit->along, (5.25 - from) / 2, 1e-6);
        }
    EXPECT_TRUE(first_hit(*shown, values.grid, {{9.0, 2.0, 3.0}, {-1.0, 0.0, 0.0}}));
    EXPECT_FALSE(first_hit(*shown, values.grid, {{9.0, 2.0, 3.0}, {1.0, 0.0, 0.0}})) << "behind";
    EXPECT_FALSE(first_hit(*shown, values.grid, {{0.0, 5.5, 3.0}, {1.0, 0.0, 0.0}})) << "beside";
    EXPECT_FALSE(first_hit(*shown, values.grid, {{0.0, 2.0, 3.0}, {0.0, 0.0, 0.0}}));
    EXPECT_FALSE(first_hit(*shown, values.grid, {{NAN, 2.0, 3.0}, {1.0, 0.0, 0.0}}));
}

TEST_F(CellRayTest, LooksOnlyAtTheSurfacesThatCount) {
    const TestField field({12, 6, 6}, 1, ValueType::f32,
                          [](double x, double, double, double) { return x; });
    const StepValues values = field.view();
    const ExtractionPtr shown = extracted(values, {Instant(0), {3.5, 7.5, NAN}});
    const Ray ray{{0.0, 2.0, 3.0}, {1.0, 0.0, 0.0}};
    EXPECT_EQ(first_hit(*shown, values.grid, ray)->surface, 0u);
    EXPECT_EQ(first_hit(*shown, values.grid, ray, 0b110)->surface, 1u);
    EXPECT_FALSE(first_hit(*shown, values.grid, ray, 0b100));
}

TEST_F(CellRayTest, SamplesAreTrilinearAndNowhereElse) {
    TestField field({5, 4, 6}, 2, ValueType::i16, white_noise(random_), {2.5, 10.0});
    StepValues values = field.view();
    values.grid = odd_grid(values.grid, random_);
    const Oracle oracle(values, 1);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 at(uniform(random_, -0.5, 4.5), uniform(random_, -0.5, 3.5),
                            uniform(random_, -0.5, 5.5));
        const bool inside =
            at.x >= 0 && at.y >= 0 && at.z >= 0 && at.x <= 4 && at.y <= 3 && at.z <= 5;
        const auto value = value_at(values, 1, in_grid(values.grid, at));
        ASSERT_EQ(value.has_value(), inside);
        if (!inside)
            continue;
        const glm::dvec3 low = glm::floor(at);
        EXPECT_NEAR(*value,
                    oracle.value({std::uint32_t(low.x), std::uint32_t(low.y), std::uint32_t(low.z)},
                                 at - low),
                    1e-9);
    }
    const auto last =
        value_at(values, 1,
                 in_grid(values.grid, {4, 3, 5}) - 1e-9 * values.grid.direction * glm::dvec3(1.0));
    ASSERT_TRUE(last);
    EXPECT_NEAR(*last, scaled_value(values, 1, 5 * 4 * 6 - 1), 1e-5);
}

} // namespace
} // namespace isochron::index
