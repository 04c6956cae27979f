// Cells of mixed levels are exactly those of the levels' definitions, and never too many.
#include "index/detail/detail_regions.h"
#include "index/extraction/cell_ray.h"
#include "index/extraction/extraction.h"
#include "index/indexing/index_build.h"
#include "index/search/layer_search.h"
#include "index/surface/cell_colors.h"
#include "index/surface/coarse_planes.h"
#include "tests/index/detail/lost_slowly.h"
#include "tests/support/memory_series.h"
#include "tests/support/reader_fixtures.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace isochron::index {
namespace {

/// x, y, z in level 0 cells, doubled; the packed plane.
using Mixed = std::tuple<unsigned, unsigned, unsigned, std::uint32_t>;

std::multiset<Mixed> mixed(std::span<const CellPoint> points) {
    std::multiset<Mixed> all;
    for (const CellPoint& p : points)
        all.emplace(p.x, p.y, p.z, p.plane);
    return all;
}

/// Whether the boxes [a, b) and [c, d] touch along every axis.
using Box = std::array<std::array<long, 2>, 3>;
bool touch(const Box& a, const Box& b) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (a[axis][1] <= b[axis][0] || b[axis][1] <= a[axis][0])
            return false;
    return true;
}

Box region_box(const DetailRegions& regions, std::size_t number) {
    Box box;
    const auto at = regions.at(number);
    for (std::size_t axis = 0; axis < 3; ++axis)
        box[axis] = {static_cast<long>(at[axis] * regions.edge()),
                     static_cast<long>((at[axis] + 1) * regions.edge())};
    return box;
}

/// A cell of a level, widened by `by` cells of the level.
Box cell_box(const CellPoint& p, unsigned level, long by) {
    const std::array<long, 3> at{p.x, p.y, p.z};
    Box box;
    for (std::size_t axis = 0; axis < 3; ++axis)
        box[axis] = {(at[axis] - by) * (1l << level), (at[axis] + 1 + by) * (1l << level)};
    return box;
}

CellPoint at_level(CellPoint p, unsigned level) {
    for (std::uint16_t* at : {&p.x, &p.y, &p.z})
        *at = static_cast<std::uint16_t>((2u * *at + 1) << level);
    return p;
}

/// What the definition of mixed levels says, cell by cell and region by region.
std::vector<CellPoint> slowly(const std::shared_ptr<const IndexFile>& file, const Query& query,
                              std::span<const std::uint8_t> levels) {
    const DetailRegions regions(file->info().grid);
    std::vector<CellPoint> all;
    for (const unsigned level : std::set<unsigned>(levels.begin(), levels.end())) {
        CellSet set;
        set.query = query;
        EXPECT_TRUE(LayerSearch(file).search(step_in_chunks(*file, query.instant, level), set, true,
                                             true, {}));
        EXPECT_EQ(set.ids, search_level(file, level, query).ids);
        if (level > 0)
            move_planes_out(set.points, file->info().grid.spacing);
        for (const CellPoint& p : set.points) {
            unsigned own = 99;
            bool beside = false;
            for (std::size_t i = 0; i < levels.size(); ++i) {
                const Box box = region_box(regions, i);
                if (touch(cell_box(p, level, 0), box))
                    own = levels[i];
                beside |= levels[i] == level && touch(cell_box(p, level, 1), box);
            }
            if (own == level || (own < level && beside))
                all.push_back(at_level(p, level));
        }
    }
    return all;
}

class DetailSearchTest : public testing::Test {
  protected:
    std::shared_ptr<const IndexFile> indexed(const TestField& field, std::uint64_t cache = 1) {
        MemorySeries series(field.view());
        build_index(series, folder_.path() / "a.isochron", {.tiers = TierSet().with(Tier::bricks)});
        return IndexFile::open(folder_.path() / "a.isochron", cache);
    }

    test_support::TestFolder folder_;
    std::mt19937 random_{test_seed()};
};

TEST_F(DetailSearchTest, MixedLevelsAreTheirDefinitionForEveryWishAndBudget) {
    constexpr std::array<std::array<std::uint32_t, 3>, 4> kGrids{
        {{70, 67, 33}, {2, 101, 64}, {129, 2, 2}, {34, 35, 71}}};
    int made = 0, several = 0, with_lost = 0, thinned = 0;
    for (const auto& vertices : kGrids)
        for (const bool noise : {false, true}) {
            TestField field(vertices, 2, noise ? ValueType::u8 : ValueType::f32,
                            scaled(noise ? white_noise(random_) : turbulence(random_), 100, 10));
            if (!noise)
                for (int i = 0; i < 20; ++i)
                    field.at<float>(1, random_() % (vertices[0] * vertices[1] * vertices[2])) =
                        std::nanf("");
            const auto file = indexed(field);
            const Extract extract = extract_from(file);
            const DetailRegions regions(file->info().grid);
            const auto isovalues = quantiles(sorted_values(field.view()), 3);
            const std::size_t all = BruteForce(field.view(), 1).active(isovalues[1]).size();
            for (int i = 0; i < 4; ++i) {
                SurfacesQuery query{Instant(1), {isovalues[1], isovalues[2]}};
                query.detail.most_cells = 1 + (all >> (2 * i));
                if (i > 0)
                    for (std::size_t r = 0; r < regions.size(); ++r)
                        query.detail.wished.push_back(
                            static_cast<std::int8_t>(int(random_() % 24) - 12));
                const ExtractionPtr found = extract(query, {});
                if (!found->coarse()) {
                    EXPECT_LE(found->cells(), query.detail.most_cells);
                    continue;
                }
                ++made;
                ASSERT_EQ(found->detail.size(), regions.size());
                const std::set<unsigned> used(found->detail.begin(), found->detail.end());
                several += used.size() > 1;
                EXPECT_TRUE(found->shaded());
                std::vector<std::vector<CellPoint>> wanted, lost;
                for (std::size_t s = 0; s < 2; ++s) {
                    wanted.push_back(slowly(file, query.surface(s), found->detail));
                    lost.push_back(
                        lost_slowly(file, query.surface(s), wanted.back(), found->detail));
                    with_lost += !lost.back().empty();
                }
                const std::uint64_t most = query.detail.most_cells,
                                    drawn = wanted[0].size() + wanted[1].size();
                thinned += thin_slowly(lost, std::max(most / 4, drawn < most ? most - drawn : 0));
                for (std::size_t s = 0; s < 2; ++s) {
                    wanted[s].insert(wanted[s].end(), lost[s].begin(), lost[s].end());
                    EXPECT_EQ(mixed(found->surfaces[s].points), mixed(wanted[s]));
                }
                // As the wishes are, but for one that is lifted.
                for (std::size_t a = 0; a < query.detail.wished.size(); ++a)
                    for (std::size_t b = 0; b < a; ++b)
                        if (query.detail.wished[a] < query.detail.wished[b]) {
                            EXPECT_LE(found->detail[a], found->detail[b]);
                        }
                if (*used.rbegin() + 1 < file->detail_levels()) {
                    EXPECT_LE(found->cells(), 2 * query.detail.most_cells + regions.size());
                }
            }
        }
    EXPECT_GT(made, 15);
    EXPECT_GT(several, 3);
    EXPECT_GT(with_lost, 10);
    EXPECT_GT(thinned, 5);
}

TEST_F(DetailSearchTest, RegionsGiveWayOneAfterTheOtherSoThatTheBudgetIsUsed) {
    const TestField field({97, 98, 95}, 1, ValueType::f32,
                          [](double x, double y, double z, double) {
                              return std::sin(x / 9) + std::sin(y / 9) + std::sin(z / 9);
                          });
    const auto file = indexed(field);
    const DetailRegions regions(file->info().grid);
    const auto all = static_cast<double>(extract_from(file)({Instant(0), {0.2}}, {})->cells());
    const std::vector<std::uint32_t> outwards = regions.from_the_middle();
    ASSERT_EQ(std::set<std::uint32_t>(outwards.begin(), outwards.end()).size(), regions.size());
    std::vector<std::int8_t> sideways; // the left part wants to be finer by half a level
    for (std::size_t r = 0; r < regions.size(); ++r)
        sideways.push_back(regions.at(r)[0] < 1 ? 0 : DetailQuery::kPartsOfLevel / 2);
    int mixed = 0;
    for (const double part : {1.1, 2.0, 3.6, 8.0})
        for (const auto& wished : {std::vector<std::int8_t>(), sideways}) {
            SurfacesQuery query{Instant(0), {0.2}};
            query.detail.most_cells = static_cast<std::uint64_t>(all / part);
            query.detail.wished = wished;
            const ExtractionPtr found = extract_from(file)(query, {});
            ASSERT_TRUE(found->coarse());
            const double used =
                static_cast<double>(found->cells()) / static_cast<double>(query.detail.most_cells);
            EXPECT_GT(used, 0.6) << part;
            EXPECT_LE(used, 1.5) << part;
            const auto [finest, coarsest] = std::ranges::minmax(found->detail);
            EXPECT_LE(coarsest, finest + 1);
            mixed += coarsest > finest;
            // In the same order at every budget: those that want it, and from the middle on.
            bool given_way = false;
            for (const int side : {0, 1}) {
                for (const std::uint32_t r : outwards) {
                    if (!wished.empty() && side != (regions.at(r)[0] < 1 ? 0 : 1))
                        continue;
                    given_way |= found->detail[r] == coarsest && coarsest > finest;
                    EXPECT_EQ(given_way, found->detail[r] > finest) << part << " " << r;
                }
                if (wished.empty())
                    break;
            }
            EXPECT_EQ(extract_from(file)(query, {})->detail, found->detail);
        }
    EXPECT_GT(mixed, 5);
}

TEST_F(DetailSearchTest, AllCellsAreThoseOfTheVolumeWhereTheyFit) {
    const TestField field({97, 65, 41}, 1, ValueType::f32, turbulence(random_));
    for (const std::uint64_t cache : {std::uint64_t{1}, std::uint64_t{1} << 30}) {
        const auto file = indexed(field, cache);
        SurfacesQuery query{Instant(0), {0.1}};
        const ExtractionPtr wanted = extract_from(file)(query, {});
        query.detail.most_cells = 3 * wanted->cells();
        const ExtractionPtr found = extract_from(file)(query, {});
        EXPECT_FALSE(found->coarse());
        EXPECT_EQ(found->surfaces[0].ids, wanted->surfaces[0].ids);
        EXPECT_EQ(found->blocks.joined(), wanted->blocks.joined());
        query.detail.most_cells = wanted->cells() / 2;
        EXPECT_TRUE(extract_from(file)(query, {})->coarse());
    }
}

TEST_F(DetailSearchTest, FirstCrossingsAreThoseOfTheCellsOwnLevel) {
    const TestField field({70, 67, 45}, 4, ValueType::f32, turbulence(random_));
    const auto file = indexed(field);
    SurfacesQuery query{Instant(2), {0.05}};
    query.coloring = CellColoring::first_crossing;
    const ExtractionPtr whole = extract_from(file)({Instant(2), {0.05}}, {});
    query.detail.most_cells = whole->cells() / 2;
    for (std::size_t r = 0; r < DetailRegions(file->info().grid).size(); ++r)
        query.detail.wished.push_back(
            static_cast<std::int8_t>(DetailQuery::kPartsOfLevel * int(r % 3)));
    const ExtractionPtr mixed = extract_from(file)(query, {});
    ASSERT_TRUE(mixed->coarse());
    std::map<unsigned, std::vector<std::set<CellId>>> active; // by level and step
    for (unsigned level = 0; level < file->detail_levels(); ++level)
        for (std::uint32_t step = 0; step < 4; ++step) {
            const CellSet set = search_level(file, level, {Instant(step), 0.05});
            active[level].emplace_back(set.ids.begin(), set.ids.end());
        }
    const auto& points = mixed->surfaces[0].points;
    ASSERT_EQ(mixed->colors.size(), points.size());
    const auto& times = file->info().times;
    std::set<unsigned> levels;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const unsigned level = level_of_center(points[i].x);
        const auto n = file->chunks(level).info().grid.cells();
        const SlowPlace low = slow_low(points[i]);
        const CellId id = (low[0] >> level) + n[0] * ((low[1] >> level) + n[1] * (low[2] >> level));
        const auto& steps = active.at(level);
        const auto first =
            std::ranges::find_if(steps, [&](const auto& s) { return s.contains(id); });
        ASSERT_NE(first, steps.end()) << "it is active in its own level";
        levels.insert(level);
        if (steps[2].contains(id)) {
            EXPECT_EQ(mixed->colors[i],
                      color_coordinate(times[static_cast<std::size_t>(first - steps.begin())],
                                       times.front(), times.back()));
        }
    }
    EXPECT_GT(levels.size(), 1u);
}

TEST_F(DetailSearchTest, ARayHitsMixedLevelsWhereItHitsTheSurfaceToAVoxelOfThem) {
    TestField field({97, 98, 95}, 1, ValueType::f32, [](double x, double y, double z, double) {
        return 40.0 - std::hypot(x - 46, y - 50, z - 47);
    });
    index::StepValues values = field.view();
    values.grid.origin = {-3, 20, 5};
    values.grid.spacing = {0.5, 2, 1};
    MemorySeries series(values);
    build_index(series, folder_.path() / "b", {.tiers = TierSet().with(Tier::bricks)});
    const auto file = IndexFile::open(folder_.path() / "b", 1);
    const Extract extract = extract_from(file);
    SurfacesQuery query{Instant(0), {0.0}};
    const ExtractionPtr whole = extract(query, {});
    query.detail.most_cells = whole->cells() / 3;
    for (std::size_t r = 0; r < DetailRegions(values.grid).size(); ++r)
        query.detail.wished.push_back(
            static_cast<std::int8_t>(DetailQuery::kPartsOfLevel * int(r % 3)));
    const ExtractionPtr mixed = extract(query, {});
    ASSERT_TRUE(mixed->coarse());
    const double voxel = 1 << mixed->coarsest;
    std::uniform_real_distribution<double> anywhere(-80, 180);
    int hits = 0;
    for (int i = 0; i < 400; ++i) {
        const glm::dvec3 from(anywhere(random_), anywhere(random_), anywhere(random_));
        const glm::dvec3 to = glm::dvec3(46, 50, 47) + 0.25 * glm::dvec3(anywhere(random_) - 50);
        const Ray ray{values.grid.physical(from),
                      values.grid.physical(to) - values.grid.physical(from)};
        const auto exact = first_hit(*whole, values.grid, ray);
        const auto found = first_hit(*mixed, values.grid, ray);
        const glm::dvec3 d = glm::normalize(to - from), c = glm::dvec3(46, 50, 47) - from;
        const double beside = glm::length(c - glm::dot(c, d) * d);
        if (beside < 35 && glm::length(c) > 45) { // not where the ray only grazes the ball
            ASSERT_TRUE(exact && found);
            EXPECT_LE(
                glm::distance(values.grid.index_of(exact->at), values.grid.index_of(found->at)),
                voxel);
            ++hits;
        } else if (beside > 40 + voxel) {
            EXPECT_FALSE(found);
        }
    }
    EXPECT_GT(hits, 100);
    EXPECT_FALSE(first_hit(*mixed, values.grid, {{0, 0, 0}, {1, 1, 1}}, 0)) << "no surface counts";
}

TEST_F(DetailSearchTest, APositionSaysWhereACellIsAndHowLarge) {
    for (unsigned level = 0; level < 10; ++level)
        for (const std::uint32_t cell : {0u, 1u, 2u, 15u, 16u, 31u}) {
            const std::uint32_t doubled = doubled_center(cell, level);
            EXPECT_EQ(level_of_center(doubled), level);
            EXPECT_EQ(doubled / 2.0, (cell + 0.5) * (1 << level));
        }
}

} // namespace
} // namespace isochron::index
