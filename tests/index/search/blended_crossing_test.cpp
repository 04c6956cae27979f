// First crossings of blends against whole numbers of 128 bits, in which nothing is rounded.
#include "index/extraction/extraction.h"
#include "index/indexing/index_build.h"
#include "index/search/first_crossing.h"
#include "index/search/index_search.h"
#include "index/search/layer_search.h"
#include "index/surface/cell_colors.h"
#include "index/volume/instant_text.h"
#include "tests/support/level_steps.h"
#include "tests/support/memory_series.h"
#include "tests/support/test_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

namespace isochron::index {
namespace {

__extension__ using Exact = __int128;
constexpr std::uint32_t kWholeWay = Instant::kFractions;
constexpr double kParts = 16; ///< all values and isovalues of these tests are multiples of 1/16

Exact parts_of(double value) {
    return static_cast<Exact>(std::llround(value * kParts));
}

/// A vertex between two steps.
struct Vertex {
    double now, next;
    bool there() const { return std::isfinite(now) && std::isfinite(next); }
    bool above(std::uint32_t n, double isovalue) const {
        return (kWholeWay - n) * parts_of(now) + n * parts_of(next) >=
               kWholeWay * parts_of(isovalue);
    }
    /// The first n at which it may be on another side than at 0: the root, rounded up or to the next.
    std::uint32_t turn(double isovalue) const {
        const Exact way = parts_of(next) - parts_of(now), left = parts_of(isovalue) - parts_of(now);
        if (way == 0)
            return 0;
        const Exact root = kWholeWay * left / way; // towards 0
        return static_cast<std::uint32_t>(std::clamp<Exact>(root, 0, kWholeWay));
    }
};

/// By cell: the first instant at which it is active by the rule, tried at all turns of its vertices.
std::map<CellId, Instant> first_by_the_rule(const StepValues& values, double isovalue) {
    std::map<CellId, Instant> found;
    const auto [nx, ny, nz] = values.grid.vertices;
    const auto value = [&](std::size_t step, std::size_t vertex) {
        return scaled_value(values, step, vertex);
    };
    for (std::uint32_t step = 0; step < values.steps; ++step)
        for (std::uint32_t z = 0, id = 0; z + 1 < nz; ++z)
            for (std::uint32_t y = 0; y + 1 < ny; ++y)
                for (std::uint32_t x = 0; x + 1 < nx; ++x, ++id) {
                    if (found.contains(id))
                        continue;
                    std::array<Vertex, 8> corners{};
                    int above = 0, below = 0;
                    for (unsigned i = 0; i < 8; ++i) {
                        const std::size_t vertex =
                            (std::size_t{z + (i >> 2)} * ny + y + (i >> 1 & 1)) * nx + x + (i & 1);
                        corners[i].now = value(step, vertex);
                        corners[i].next = step + 1 < values.steps ? value(step + 1, vertex) : NAN;
                        above += corners[i].now >= isovalue ? 1 : 0;
                        below += corners[i].now < isovalue ? 1 : 0;
                    }
                    if (above > 0 && below > 0 && above + below == 8) {
                        found[id] = Instant(step);
                        continue;
                    }
                    if (!std::ranges::all_of(corners, &Vertex::there))
                        continue;
                    for (const Vertex& turning : corners)
                        for (std::uint32_t n = std::max(turning.turn(isovalue), 1u) - 1,
                                           end = n + 4;
                             n < std::min(end, kWholeWay); ++n) {
                            const auto count = std::ranges::count_if(
                                corners, [&](const Vertex& v) { return v.above(n, isovalue); });
                            const Instant at(step, n);
                            if (n > 0 && count > 0 && count < 8 &&
                                (!found.contains(id) || at.number() < found[id].number()))
                                found[id] = at;
                        }
                }
    return found;
}

std::shared_ptr<const IndexFile> crossing_index(const std::filesystem::path& folder,
                                                const TestField& field, bool bricks) {
    MemorySeries series(field.view());
    BuildOptions options;
    options.tiers = bricks ? TierSet().with(Tier::bricks) : TierSet();
    build_index(series, folder / "a.isochron", options);
    return IndexFile::open(folder / "a.isochron");
}

void expect_those_of_the_rule(const FirstCrossings& found, const StepValues& values) {
    const std::map<CellId, Instant> expected = first_by_the_rule(values, found.isovalue);
    std::size_t between = 0;
    for (CellId id = 0; id < found.steps.size(); ++id) {
        const auto it = expected.find(id);
        if (it == expected.end()) {
            EXPECT_EQ(found.steps[id], FirstCrossings::kNever) << id;
            continue;
        }
        ASSERT_EQ(Instant(found.steps[id], found.fractions[id]), it->second)
            << id << ": step " << found.steps[id] << " + " << found.fractions[id] << ", expected "
            << it->second.step << " + " << it->second.fraction;
        between += it->second.between() ? 1 : 0;
    }
    EXPECT_GT(between, 20u) << found.isovalue;
}

class BlendedCrossing : public testing::TestWithParam<ValueType> {};

TEST_P(BlendedCrossing, IsTheFirstInstantOfEachCellInExactArithmetic) {
    std::mt19937 random(test_seed());
    const ValueType type = GetParam();
    for (const bool bricks : {true, false}) {
        const test_support::TestFolder folder;
        const auto waves = turbulence(random);
        TestField field({37, 21, 19}, 4, type, [&](double x, double y, double z, double t) {
            return std::round(kParts * (60 + 40 * waves(x, y, z, t))) / kParts;
        });
        // Front of equal values: whole cells cross at once, which are active at no instant.
        const auto plant = [&]<class T>(T) {
            for (std::size_t vertex = 0; vertex < 37 * 21 * 4; ++vertex)
                for (std::size_t step = 0; step < 4; ++step)
                    field.at<T>(step, vertex) = static_cast<T>(50 + 10 * step);
            std::uniform_int_distribution<std::size_t> any(37 * 21 * 5, 37 * 21 * 19 - 1);
            if constexpr (std::is_floating_point_v<T>)
                for (std::size_t step = 0; step < 4; ++step) {
                    field.at<T>(step, any(random)) = std::numeric_limits<T>::quiet_NaN();
                    field.at<T>(step, any(random)) = std::numeric_limits<T>::infinity();
                }
        };
        visit_value_type(type, [&]<class T>(std::type_identity<T>) { plant(T{}); });
        const auto file = crossing_index(folder.path(), field, bricks);
        for (const double isovalue : {55.0, 60.0, 65.0625, 72.5}) {
            const auto found = first_crossings(file->info(), search_in(file), isovalue, {},
                                               crossings_between(file, 0, isovalue, {}));
            ASSERT_TRUE(found && found->blended());
            expect_those_of_the_rule(*found, field.view());
        }
        if (type == ValueType::f32 || type == ValueType::f64)
            continue; // infinities are above any isovalue at steps
        const auto none = first_crossings(file->info(), search_in(file), 1e6, {},
                                          crossings_between(file, 0, 1e6, {}));
        EXPECT_EQ(std::ranges::count(none->steps, FirstCrossings::kNever),
                  static_cast<std::ptrdiff_t>(none->steps.size()));
    }
}

INSTANTIATE_TEST_SUITE_P(Types, BlendedCrossing,
                         testing::Values(ValueType::u8, ValueType::i16, ValueType::u16,
                                         ValueType::i32, ValueType::f32, ValueType::f64),
                         [](const auto& of) { return std::string(name_of(of.param)); });

TEST(BlendedCrossings, ColorEveryCellNoLaterThanItIsShownAndAtStepsAsBetweenThem) {
    const test_support::TestFolder folder;
    // A front that moves by eight cells a step: most of its cells between steps are in no step.
    const TestField field({64, 20, 20}, 6, ValueType::f32,
                          [](double x, double, double, double t) { return 8 * t + 8.5 - x; });
    const auto file = crossing_index(folder.path(), field, true);
    const auto extract = extract_from(file, std::nullopt, Shading::cells);
    const std::vector<double>& times = file->info().times;
    for (const Instant at : {Instant(2, 32768), Instant(3, 65535), Instant(3), Instant(5)}) {
        const auto set = extract(
            {.instant = at, .isovalues = {0.0}, .coloring = CellColoring::first_blended_crossing},
            {});
        ASSERT_TRUE(set && set->cells() == 19u * 19);
        for (std::size_t i = 0; i < set->cells(); ++i) {
            // A cell from x to x + 1 is active as soon as the front has passed x.
            const double x = set->surfaces[0].points[i].x;
            const double first = std::max(0.0, std::ceil((x - 8.5) / 8 * kWholeWay) / kWholeWay);
            const auto step = static_cast<std::uint32_t>(first);
            const Instant exact(step, static_cast<std::uint32_t>((first - step) * kWholeWay));
            EXPECT_LE(exact.number(), at.number());
            EXPECT_EQ(set->colors[i],
                      color_coordinate(time_at(times, exact), times.front(), times.back()));
        }
    }
}

TEST(BlendedCrossings, OfALevelOfDetailAreThoseOfItsOwnValues) {
    std::mt19937 random(test_seed());
    const auto waves = turbulence(random);
    const TestField field({70, 66, 68}, 2, ValueType::i16,
                          [&](double x, double y, double z, double t) {
                              return std::round(500 * waves(x, y, z, t));
                          });
    const test_support::TestFolder folder;
    const auto file = crossing_index(folder.path(), field, true);
    ASSERT_GT(file->detail_levels(), 1u);
    const LevelSteps coarse(file, 1);
    const Search search = [&](const Query& query, const std::stop_token&) {
        return std::make_shared<const CellSet>(search_level(file, 1, query));
    };
    const auto found = first_crossings(file->chunks(1).info(), search, 100.5, {},
                                       crossings_between(file, 1, 100.5, {}));
    ASSERT_TRUE(found);
    expect_those_of_the_rule(*found, coarse.view());
}

TEST(BlendedCrossings, StopWhenTheyAreToldTo) {
    const test_support::TestFolder folder;
    const TestField field({20, 20, 20}, 3, ValueType::f32, moving_sphere);
    const auto file = crossing_index(folder.path(), field, true);
    std::stop_source stop;
    stop.request_stop();
    const Search search = search_in(file);
    EXPECT_FALSE(first_crossings(
        file->info(), [&](const Query& query, const std::stop_token&) { return search(query, {}); },
        40, {}, crossings_between(file, 0, 40, stop.get_token())));
}

} // namespace
} // namespace isochron::index
