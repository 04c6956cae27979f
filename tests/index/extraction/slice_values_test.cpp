// Values on slices, each against its definition: the trilinear value in the cell around a place.
#include "index/extraction/slice_values.h"
#include "tests/support/indexed.h"
#include "tests/support/test_seed.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace isochron::index {
namespace {

using Random = std::mt19937;

double uniform_in(Random& random, double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
}

Grid random_grid(Random& random) {
    Grid grid;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        grid.vertices[axis] = 2 + random() % 38;
        grid.spacing[static_cast<int>(axis)] = std::pow(10, uniform_in(random, -2, 2));
    }
    grid.origin = {uniform_in(random, -50, 50), uniform_in(random, -50, 50), 3.5};
    const glm::dvec3 about(1, uniform_in(random, -1, 1), uniform_in(random, -1, 1));
    if (random() % 2)
        grid.direction = glm::dmat3(
            glm::mat3_cast(glm::angleAxis(uniform_in(random, 0, 3), glm::normalize(about))));
    if (random() % 2)
        grid.direction[2] = -grid.direction[2]; // stored left-handed
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (random() % 3)
            continue;
        std::vector<double> at{0.0};
        while (at.size() < grid.vertices[axis])
            at.push_back(at.back() + std::pow(10, uniform_in(random, -1, 1)));
        grid.spacing[static_cast<int>(axis)] = at.back() / (grid.vertices[axis] - 1);
        grid.positions[axis] = AxisPositions(std::move(at));
    }
    return grid;
}

/// Distance of a vertex from the first along an axis, straight from the grid's members.
double distance_of(const Grid& grid, int axis, std::uint32_t vertex) {
    const auto& at = grid.positions[static_cast<std::size_t>(axis)].distances();
    return at.empty() ? grid.spacing[axis] * vertex : at[vertex];
}

/// A vertex and the share of the way to the next one, of a place along an axis.
struct Along {
    std::uint32_t cell;
    double share;
};
Along along(const Grid& grid, int axis, double distance) {
    std::uint32_t cell = 0;
    while (cell + 2 < grid.vertices[static_cast<std::size_t>(axis)] &&
           distance >= distance_of(grid, axis, cell + 1))
        ++cell;
    const double low = distance_of(grid, axis, cell), high = distance_of(grid, axis, cell + 1);
    return {cell, (distance - low) / (high - low)};
}

struct Place {
    glm::dvec3 at; ///< physical
    std::array<Along, 3> in_cells;
    bool near_border = false; ///< border of a cell: rounding may find the next one
};

/// A random place of a plane within the grid; nothing: tried in vain.
std::optional<Place> place_on(const Grid& grid, const SliceQuery& plane, Random& random) {
    for (int tries = 0; tries < 200; ++tries) {
        Place place;
        glm::dvec3 along_axes;
        for (int axis = 0; axis < 3; ++axis)
            along_axes[axis] =
                uniform_in(random, 0, 1) *
                distance_of(grid, axis, grid.vertices[static_cast<std::size_t>(axis)] - 1);
        place.at = grid.origin + grid.direction * along_axes;
        place.at -= glm::dot(place.at - plane.point, plane.normal) * plane.normal;
        along_axes = glm::transpose(grid.direction) * (place.at - grid.origin);
        bool inside = true;
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const double last = distance_of(grid, axis, grid.vertices[a] - 1);
            inside =
                inside && along_axes[axis] >= -1e-9 * last && along_axes[axis] <= (1 + 1e-9) * last;
            place.in_cells[a] = along(grid, axis, along_axes[axis]);
            const double share = place.in_cells[a].share;
            place.near_border = place.near_border || share < 1e-6 || share > 1 - 1e-6;
        }
        if (inside)
            return place;
    }
    return std::nullopt;
}

/// The value by its definition: of the eight vertices, blended between two steps.
double expected_at(const StepValues& values, const Place& place, Instant at) {
    const auto& n = values.grid.vertices;
    double sum = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        std::array<std::uint32_t, 3> vertex{};
        double weight = 1;
        for (unsigned axis = 0; axis < 3; ++axis) {
            const bool up = corner >> axis & 1;
            vertex[axis] = place.in_cells[axis].cell + up;
            weight *= up ? place.in_cells[axis].share : 1 - place.in_cells[axis].share;
        }
        const auto value = [&](std::size_t step) {
            return visit_value_type(values.type, [&]<class T>(std::type_identity<T>) {
                const std::size_t i =
                    (std::size_t{vertex[2]} * n[1] + vertex[1]) * n[0] + vertex[0];
                return values.scaling(static_cast<double>(values.step<T>(step)[i]));
            });
        };
        const double share = at.fraction / double{Instant::kFractions};
        sum += weight * (at.between() ? (1 - share) * value(at.step) + share * value(at.step + 1)
                                      : value(at.step));
    }
    return sum;
}

TEST(SliceValues, AreTrilinearForEveryTypeGridPlaneAndInstant) {
    Random random(test_seed());
    constexpr std::array kTypes{ValueType::i8,  ValueType::u8,  ValueType::i16, ValueType::u16,
                                ValueType::i32, ValueType::f32, ValueType::f64};
    int values = 0, holes = 0;
    for (int round = 0; round < 42; ++round) {
        const Grid grid = random_grid(random);
        const ValueType type = kTypes[static_cast<std::size_t>(round) % kTypes.size()];
        const bool floats = type == ValueType::f32 || type == ValueType::f64;
        const TestField field(grid.vertices, 2, type, [&](double, double, double, double) {
            return floats && random() % 400 == 0 ? std::numeric_limits<double>::quiet_NaN()
                                                 : uniform_in(random, 1, 120);
        });
        StepValues stored = field.view();
        stored.grid = grid;
        if (!floats)
            stored.scaling = {-0.25, 7};
        const test_support::TestFolder folder;
        const auto file = indexed(folder, stored);
        for (int each = 0; each < 4; ++each) {
            SliceQuery plane{.instant = each < 2 ? Instant(1) : Instant(0, 20000)};
            const glm::dvec3 middle = grid.physical(
                glm::dvec3(grid.vertices[0] - 1, grid.vertices[1] - 1, grid.vertices[2] - 1) * 0.5);
            if (each % 2) { // through vertices, from the first plane of them to the last
                const int axis = static_cast<int>(random() % 3);
                const std::uint32_t count = grid.vertices[static_cast<std::size_t>(axis)];
                const std::uint32_t vertex = std::array<std::uint32_t, 3>{
                    0, count - 1, static_cast<std::uint32_t>(random() % count)}[random() % 3];
                plane.normal = grid.direction[axis];
                plane.point = grid.origin + grid.direction[axis] * distance_of(grid, axis, vertex);
            } else {
                plane.normal = glm::normalize(
                    glm::dvec3(uniform_in(random, -1, 1), uniform_in(random, -1, 1), 0.1));
                plane.point = middle;
            }
            const SliceValues slice = slice_values(*file, plane);
            ASSERT_GE(slice.outline.size(), 3u) << round << " " << each;
            for (int i = 0; i < 60; ++i) {
                const auto place = place_on(grid, plane, random);
                if (!place)
                    break;
                const double expected = expected_at(stored, *place, plane.instant);
                const auto found = value_on(slice, grid, place->at);
                if (!std::isfinite(expected) || place->near_border) {
                    // At a border of cells the value is that of either, which may be a hole.
                    holes += !found;
                    EXPECT_TRUE(place->near_border || !found);
                    if (!found || !std::isfinite(expected))
                        continue;
                }
                ASSERT_TRUE(found) << round << " " << each;
                EXPECT_NEAR(*found, expected, 2e-5 * std::abs(expected) + 1e-5)
                    << name_of(type) << " round " << round << " plane " << each;
                ++values;
            }
        }
    }
    EXPECT_GT(values, 5000);
    EXPECT_GT(holes, 20);
}

TEST(SliceValues, ThatMissTheDataAreEmpty) {
    const TestField field({5, 5, 5}, 1, ValueType::f32,
                          [](double x, double, double, double) { return x; });
    const test_support::TestFolder folder;
    const auto file = indexed(folder, field.view());
    const SliceValues slice = slice_values(*file, {.point = {0, 0, 4.01}, .normal = {0, 0, 1}});
    EXPECT_TRUE(slice.outline.empty() && slice.shares.empty());
    EXPECT_FALSE(value_on(slice, field.view().grid, {1, 1, 4}));
}

TEST(SliceValues, OfALargeStepReadOnlyTheChunksThatThePlaneCuts) {
    Random random(test_seed());
    const TestField field({192, 160, 160}, 1, ValueType::f32,
                          [&](double, double, double, double) { return uniform_in(random, 0, 1); });
    const test_support::TestFolder folder;
    indexed(folder, field.view());
    const auto file = IndexFile::open(folder.path() / "a.isochron", 64 << 20);
    const std::uint64_t whole = std::uint64_t{192} * 160 * 160 * 4, before = file->reading().bytes;
    const SliceValues slice = slice_values(*file, {.point = {0, 0, 40.5}, .normal = {0, 0, 1}});
    // One layer of chunks of ten, and what is read around small gaps.
    EXPECT_LT(file->reading().bytes - before, whole / 5);
    EXPECT_GT(file->reading().bytes - before, whole / 12);
    const std::size_t at = (std::size_t{40} * 160 + 7) * 192 + 5;
    const auto values = field.view().step<float>(0);
    const double expected = (double{values[at]} + double{values[at + 192 * 160]}) / 2;
    EXPECT_NEAR(*value_on(slice, field.view().grid, {5, 7, 40.5}), expected, 1e-6);
}

} // namespace
} // namespace isochron::index
