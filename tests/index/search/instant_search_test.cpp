// Cells between two steps against a scan of exactly blended values.
#include "index/extraction/extraction.h"
#include "index/extraction/value_in_index.h"
#include "index/file/chunks/spare_memory.h"
#include "index/file/detail_levels.h"
#include "index/indexing/index_build.h"
#include "index/search/cell_change.h"
#include "index/search/index_search.h"
#include "index/search/layer_search.h"
#include "index/search/near_blend.h"
#include "index/search/surface_mesh.h"
#include "index/surface/cell_colors.h"
#include "index/volume/blend.h"
#include "index/volume/instant_text.h"
#include "tests/support/level_steps.h"
#include "tests/support/memory_series.h"
#include "tests/support/test_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <set>

namespace isochron::index {
namespace {

constexpr std::uint32_t kWhole = Instant::kFractions;

/// The active cells by the rule, vertex by vertex.
std::vector<CellId> by_the_rule(const StepValues& values, Instant at, double isovalue) {
    const Grid& grid = values.grid;
    const auto [nx, ny, nz] = grid.vertices;
    const auto vertices = static_cast<std::size_t>(grid.vertex_count());
    std::vector<double> blend(vertices);
    for (std::size_t i = 0; i < vertices; ++i)
        blend[i] = at.within(values.steps).between()
                       ? blended(scaled_value(values, at.step, i),
                                 scaled_value(values, at.step + 1, i), at.fraction)
                       : scaled_value(values, at.step, i);
    std::vector<CellId> cells;
    CellId id = 0;
    for (std::uint32_t z = 0; z + 1 < nz; ++z)
        for (std::uint32_t y = 0; y + 1 < ny; ++y)
            for (std::uint32_t x = 0; x + 1 < nx; ++x, ++id) {
                int above = 0, below = 0;
                for (unsigned corner = 0; corner < 8; ++corner) {
                    const std::size_t vertex =
                        (std::size_t{z + (corner >> 2)} * ny + y + (corner >> 1 & 1)) * nx + x +
                        (corner & 1);
                    above += blend[vertex] >= isovalue ? 1 : 0;
                    below += blend[vertex] < isovalue ? 1 : 0;
                }
                if (above > 0 && below > 0 && above + below == 8)
                    cells.push_back(id);
            }
    return cells;
}

std::shared_ptr<const IndexFile> built(const std::filesystem::path& folder, const TestField& field,
                                       bool bricks = true) {
    MemorySeries series(field.view());
    const auto path = folder / "a.isochron";
    BuildOptions options;
    options.tiers = bricks ? TierSet().with(Tier::bricks) : TierSet();
    build_index(series, path, options);
    return IndexFile::open(path);
}

std::vector<CellId> found(const std::shared_ptr<const IndexFile>& file, const Query& query,
                          Shading shading = Shading::cells) {
    return search_in(file, std::nullopt, shading)(query, {})->ids;
}

/// Isovalues at which some blended vertex lies, just above and just below them, and others.
std::vector<double> isovalues_at(const StepValues& values, Instant at, std::mt19937& random) {
    std::vector<double> all;
    std::uniform_int_distribution<std::size_t> vertex(0, values.grid.vertex_count() - 1);
    while (all.size() < 6) {
        const std::size_t i = vertex(random);
        const double value = at.between()
                                 ? blended(scaled_value(values, at.step, i),
                                           scaled_value(values, at.step + 1, i), at.fraction)
                                 : scaled_value(values, at.step, i);
        if (!std::isfinite(value))
            continue;
        all.push_back(value);
        all.push_back(std::nextafter(value, all.size() % 2 ? kInfinity : -kInfinity));
    }
    return all;
}

class InstantSearch : public testing::TestWithParam<std::tuple<ValueType, Scaling>> {};

TEST_P(InstantSearch, FindsTheCellsOfTheRuleAtRandomInstants) {
    const auto [type, scaling] = GetParam();
    std::mt19937 random(test_seed());
    const std::array<std::array<std::uint32_t, 3>, 4> sizes{
        {{2, 2, 2}, {33, 17, 18}, {37, 31, 29}, {16, 50, 3}}};
    for (const auto& size : sizes) {
        const test_support::TestFolder folder;
        TestField field(size, 4, type, scaled(turbulence(random), 60, 70), scaling);
        if (type == ValueType::f32 || type == ValueType::f64) {
            const auto plant = [&]<class T>(T) {
                std::uniform_int_distribution<std::size_t> vertex(
                    0, field.view().grid.vertex_count() - 1);
                for (std::size_t step = 0; step < 4; ++step) {
                    field.at<T>(step, vertex(random)) = std::numeric_limits<T>::quiet_NaN();
                    field.at<T>(step, vertex(random)) = std::numeric_limits<T>::infinity();
                    field.at<T>(step, vertex(random)) = -std::numeric_limits<T>::infinity();
                    field.at<T>(step, vertex(random)) = std::numeric_limits<T>::max();
                }
            };
            if (size[0] > 2)
                type == ValueType::f32 ? plant(float{}) : plant(double{});
        }
        const auto file = built(folder.path(), field);
        for (int i = 0; i < std::max(2, tries(6)); ++i) {
            const Instant at(static_cast<std::uint32_t>(random() % 4),
                             i == 0 ? 0 : static_cast<std::uint32_t>(random() % kWhole));
            for (const double isovalue : isovalues_at(field.view(), at.within(4), random))
                ASSERT_EQ(found(file, {at, isovalue}), by_the_rule(field.view(), at, isovalue))
                    << size[0] << ": step " << at.step << " + " << at.fraction << "/65536, "
                    << isovalue;
        }
    }
}

/// Values of each step that have nothing to do with each other, the outermost ones among them.
void fill_at_random(TestField& field, ValueType type, std::mt19937& random) {
    visit_value_type(type, [&]<class T>(std::type_identity<T>) {
        for (std::size_t step = 0; step < field.view().steps; ++step)
            for (std::size_t i = 0; i < field.view().grid.vertex_count(); ++i) {
                T& value = field.at<T>(step, i);
                switch (random() % 16) {
                case 0: value = std::numeric_limits<T>::lowest(); break;
                case 1: value = std::numeric_limits<T>::max(); break;
                case 2: value = std::numeric_limits<T>::quiet_NaN(); break; // or 0
                case 3: value = std::numeric_limits<T>::infinity(); break;  // or 0
                case 4: break;                                              // as neighbors are
                default: value = static_cast<T>(static_cast<double>(random() % 100)); break;
                }
            }
    });
}

TEST_P(InstantSearch, FindsTheSameOfWholeStepsAndOfChunksWhateverTheValuesAre) {
    const auto [type, scaling] = GetParam();
    std::mt19937 random(test_seed());
    const test_support::TestFolder folder;
    TestField field({35, 21, 34}, 3, type, scaled(turbulence(random), 20, 50), scaling);
    const auto turbulent = built(folder.path(), field);
    const auto check = [&](const std::shared_ptr<const IndexFile>& whole,
                           std::initializer_list<std::uint32_t> fractions) {
        // Steps are no small part of this cache, so chunks alone are read.
        const auto chunks = IndexFile::open(whole->name(), field.view().step_bytes(0).size());
        for (const std::uint32_t fraction : fractions) {
            const Instant at(static_cast<std::uint32_t>(random() % 2), fraction);
            ASSERT_TRUE(NearBlend::worth(step_of(*whole, at)));
            ASSERT_FALSE(NearBlend::worth(step_of(*chunks, at)));
            for (const double isovalue : isovalues_at(field.view(), at, random)) {
                const Query query{at, isovalue};
                const CellSetPtr one = search_in(whole, SearchMethod::bricks, Shading::cells)(query,
                                                                                              {}),
                                 other = search_in(chunks, SearchMethod::bricks,
                                                   Shading::cells)(query, {});
                ASSERT_EQ(one->ids, by_the_rule(field.view(), at, isovalue)) << at.number();
                ASSERT_EQ(other->ids, one->ids) << at.number();
                ASSERT_TRUE(std::ranges::equal(one->points, other->points,
                                               [](const CellPoint& a, const CellPoint& b) {
                                                   return std::memcmp(&a, &b, sizeof a) == 0;
                                               }));
                ASSERT_EQ(one->rows.size(), other->rows.size());
            }
        }
    };
    const auto any = [&] { return 1 + static_cast<std::uint32_t>(random() % (kWhole - 1)); };
    check(turbulent, {1u, any()});
    fill_at_random(field, type, random);
    check(built(folder.path(), field), {65535u, 32768u});
}

INSTANTIATE_TEST_SUITE_P(Types, InstantSearch,
                         testing::Combine(testing::ValuesIn(kAllTypes),
                                          testing::ValuesIn(kScalings)),
                         [](const auto& of) {
                             return fmt::format("{}_{}", name_of(std::get<0>(of.param)), of.index);
                         });

TEST(InstantSearch, ColorsByFirstCrossingNoCellLaterThanTheMomentAndEachCell) {
    const test_support::TestFolder folder;
    // Moves by eight cells a step: most of its cells between steps are in no step.
    const TestField field({64, 20, 20}, 6, ValueType::f32,
                          [](double x, double, double, double t) { return 8 * t + 8.5 - x; });
    const auto file = built(folder.path(), field);
    const auto extract = extract_from(file, std::nullopt, Shading::cells);
    const auto color_of = [&](double time) {
        return color_coordinate(time, file->info().times.front(), file->info().times.back());
    };
    for (const Instant at : {Instant(2, 32768), Instant(3, 65535), Instant(3)}) {
        const auto set = extract(
            {.instant = at, .isovalues = {0.0}, .coloring = CellColoring::first_crossing}, {});
        ASSERT_TRUE(set);
        ASSERT_EQ(set->cells(), 19u * 19);
        for (const std::uint16_t color : set->colors)
            EXPECT_EQ(color, color_of(time_at(file->info().times, at))) << at.number();
    }
}

TEST(InstantSearch, MakesTheRanksOfAMomentOnceForAllPlacesThatAreLookedAtThere) {
    const test_support::TestFolder folder;
    std::mt19937 random(test_seed());
    const TestField field({48, 40, 36}, 4, ValueType::f32, scaled(turbulence(random), 60, 70));
    const auto file = built(folder.path(), field);
    const ByteCache& kept = file->chunks().for_blends().ranks;
    const Instant at(1, 12345);
    const auto extract = extract_from(file, std::nullopt, Shading::cells);
    for (const double isovalue : {60.0, 70.0, 80.0}) // known, so that few blends tell its ranks
        ASSERT_TRUE(extract({.instant = at, .isovalues = {isovalue}, .mesh_room = 1 << 24}, {}));
    for (int i = 0; i < 10; ++i) // the pointer hovers
        ASSERT_TRUE(value_in(*file, at, {3.0 + i, 4, 5}));
    EXPECT_EQ(kept.use().misses, 1u);
    EXPECT_EQ(kept.use().hits, 9u);
    for (std::uint32_t n = 1; n <= 100; ++n) // time plays on
        ASSERT_TRUE(value_in(*file, Instant(2, 600 * n), {3, 4, 5}));
    EXPECT_EQ(kept.use().misses, 101u);
    EXPECT_LE(kept.use().held, BlendMemory::kRankBytes);
    EXPECT_EQ(found(file, {at, 70.0}), by_the_rule(field.view(), at, 70.0));
}

TEST(InstantSearch, FindsTheCellThatIsWhollyBelowAtOneStepAndWhollyAboveAtTheNext) {
    const test_support::TestFolder folder;
    // A front that moves by eight cells a step: between the steps it lies where neither has it.
    const TestField field({40, 20, 20}, 2, ValueType::u8, [](double x, double, double, double t) {
        return 10 * (8 + 8 * t - x) + 100;
    });
    const auto file = built(folder.path(), field);
    const std::vector<CellId> now = found(file, {Instant(0), 101}),
                              next = found(file, {Instant(1), 101}),
                              between = found(file, {{0, kWhole / 2}, 101});
    EXPECT_EQ(between, by_the_rule(field.view(), {0, kWhole / 2}, 101));
    EXPECT_FALSE(between.empty());
    for (const CellId cell : between) {
        EXPECT_FALSE(std::ranges::binary_search(now, cell));
        EXPECT_FALSE(std::ranges::binary_search(next, cell));
    }
}

TEST(InstantSearch, IsTheSameByAScanAndWithoutNormals) {
    std::mt19937 seeded(test_seed());
    const auto random = [&] { return static_cast<std::uint32_t>(seeded()); };
    const TestField field({35, 18, 33}, 3, ValueType::f32, turbulence(seeded));
    const test_support::TestFolder folder, other;
    const auto with = built(folder.path(), field), without = built(other.path(), field, false);
    for (int i = 0; i < 20; ++i) {
        const Query query{{random() % 2, 1 + random() % (kWhole - 1)},
                          static_cast<double>(random() % 100) / 100 - 0.5};
        const std::vector<CellId> expected =
            by_the_rule(field.view(), query.instant, query.isovalue);
        EXPECT_EQ(found(with, query), expected);
        EXPECT_EQ(found(with, query, Shading::none), expected);
        EXPECT_EQ(found(without, query), expected);
    }
}

TEST(InstantSearch, LevelsOfDetailAreBlendedByTheSameRule) {
    std::mt19937 random(test_seed());
    const TestField field({90, 70, 66}, 2, ValueType::i16, scaled(turbulence(random), 900, 0));
    const test_support::TestFolder folder;
    const auto file = built(folder.path(), field);
    ASSERT_GT(file->detail_levels(), 1u);
    for (std::size_t level = 1; level < file->detail_levels(); ++level) {
        const LevelSteps coarse(file, level);
        const Query query{{0, 12345}, 100.5};
        EXPECT_EQ(search_level(file, level, query).ids,
                  by_the_rule(coarse.view(), query.instant, query.isovalue));
    }
}

TEST(InstantSearch, AtAStepNothingDiffersFromTheStepAlone) {
    std::mt19937 random(test_seed());
    const TestField field({35, 34, 33}, 3, ValueType::u16, scaled(turbulence(random), 900, 5000));
    const test_support::TestFolder folder;
    const auto file = built(folder.path(), field);
    const Extract extract = extract_from(file, std::nullopt, Shading::cells);
    const ExtractionPtr alone = extract({.instant = Instant(1), .isovalues = {5000, 5100}}, {});
    (void)extract({.instant = {1, 77}, .isovalues = {5000, 5100}}, {});
    const ExtractionPtr again = extract({.instant = {1, 0}, .isovalues = {5000, 5100}}, {});
    const auto same = [](const CellPoint& a, const CellPoint& b) {
        return std::memcmp(&a, &b, sizeof a) == 0;
    };
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(again->surfaces[i].ids, alone->surfaces[i].ids);
        EXPECT_TRUE(std::ranges::equal(again->surfaces[i].points, alone->surfaces[i].points, same));
    }
    EXPECT_EQ(again->levels, alone->levels);
    EXPECT_EQ(again->blocks.ids, alone->blocks.ids);
    EXPECT_EQ(again->blocks.joined(), alone->blocks.joined());
    EXPECT_EQ(again->surroundings.shares, alone->surroundings.shares);
}

TEST(InstantSearch, BlocksOfAnInstantHaveEveryVertexOnItsSide) {
    std::mt19937 random(test_seed());
    for (const ValueType type : {ValueType::u8, ValueType::f32}) {
        const TestField field({35, 34, 33}, 2, type, scaled(turbulence(random), 60, 120));
        const test_support::TestFolder folder;
        const auto file = built(folder.path(), field);
        const Extract extract = extract_from(file, std::nullopt, Shading::cells);
        const Instant at{0, 23456};
        const double isovalue = 125.25;
        const ExtractionPtr made = extract({.instant = at, .isovalues = {isovalue}}, {});
        ASSERT_EQ(made->surfaces[0].ids, by_the_rule(field.view(), at, isovalue));
        const VolumeBlocks& blocks = made->blocks;
        ASSERT_EQ(blocks.held, ValueType::f32);
        ASSERT_FALSE(blocks.ids.empty());
        const BlockTiling tiling(field.view().grid);
        for (std::size_t i = 0; i < blocks.ids.size(); ++i) {
            const std::array<std::uint32_t, 3> first{
                blocks.ids[i] % tiling.blocks[0] * kBlockEdge,
                blocks.ids[i] / tiling.blocks[0] % tiling.blocks[1] * kBlockEdge,
                blocks.ids[i] / tiling.blocks[0] / tiling.blocks[1] * kBlockEdge};
            const auto* held = reinterpret_cast<const float*>(blocks.block(i).data());
            for (std::uint32_t vertex = 0; vertex < kBlockVertices; ++vertex) {
                const std::uint32_t x = first[0] + vertex % kBlockEdge,
                                    y = first[1] + vertex / kBlockEdge % kBlockEdge,
                                    z = first[2] + vertex / kBlockEdge / kBlockEdge;
                if (x >= 35 || y >= 34 || z >= 33)
                    continue;
                const std::size_t number = (std::size_t{z} * 34 + y) * 35 + x;
                const double value = blended(scaled_value(field.view(), 0, number),
                                             scaled_value(field.view(), 1, number), at.fraction);
                EXPECT_EQ(held[vertex] * blocks.factor < made->levels[0], value < isovalue);
            }
        }
    }
}

TEST(InstantSearch, MeshesAndValuesAreThoseOfTheBlend) {
    std::mt19937 random(test_seed());
    // Blends of these halfway are doubles, so that a series of them can hold them as steps.
    const TestField field({30, 29, 31}, 2, ValueType::i16, scaled(turbulence(random), 900, 0));
    const StepValues values = field.view();
    TestField middle({30, 29, 31}, 1, ValueType::f64,
                     [](double, double, double, double) { return 0; });
    for (std::size_t i = 0; i < values.grid.vertex_count(); ++i)
        middle.at<double>(0, i) = (scaled_value(values, 0, i) + scaled_value(values, 1, i)) / 2;
    const test_support::TestFolder folder, other;
    const auto file = built(folder.path(), field), halfway = built(other.path(), middle);
    const auto mesh = [](const std::shared_ptr<const IndexFile>& of, const Query& query) {
        return *SurfaceMeshes(of).make_packed(query);
    };
    const CellMesh found = mesh(file, {{0, kWhole / 2}, 33}),
                   expected = mesh(halfway, {Instant(0), 33});
    EXPECT_FALSE(found.triangles.empty());
    EXPECT_EQ(found.vertices, expected.vertices);
    EXPECT_EQ(found.triangles, expected.triangles);
    for (int i = 0; i < 50; ++i) {
        const auto along = [&](double cells) {
            return std::uniform_real_distribution<double>(0, cells)(random);
        };
        const glm::dvec3 at(along(29), along(28), along(30));
        EXPECT_EQ(value_in(*file, {0, kWhole / 2}, at), value_in(*halfway, Instant(0), at));
    }
}

TEST(InstantSearch, TheLastStepHolds) {
    std::mt19937 random(test_seed());
    const TestField field({20, 20, 20}, 2, ValueType::f32, turbulence(random));
    const test_support::TestFolder folder;
    const auto file = built(folder.path(), field);
    EXPECT_EQ(found(file, {{1, 777}, 0.1}), found(file, {Instant(1), 0.1}));
}

TEST(InstantSearch, ChangesBetweenInstantsAreTheDifferencesOfTheirSets) {
    std::mt19937 random(test_seed());
    const TestField field({20, 33, 20}, 2, ValueType::u8, scaled(turbulence(random), 60, 120));
    const test_support::TestFolder folder;
    const auto file = built(folder.path(), field);
    ChangeSearch search(file);
    const Query from{{0, 1000}, 120}, to{{0, 60000}, 120};
    const CellChange change = search(from, to);
    EXPECT_TRUE(change.whole);
    EXPECT_EQ(std::vector<CellId>(change.added.begin(), change.added.end()),
              by_the_rule(field.view(), to.instant, 120));
    const CellChange none = search(to, to);
    EXPECT_FALSE(none.whole);
    EXPECT_TRUE(none.added.empty() && none.removed.empty());
}

TEST(InstantSearch, FewBricksAreTestedInVainWhereMotionIsSlow) {
    const std::array<std::uint32_t, 3> n{61, 50, 60};
    const TestField field(n, 8, ValueType::f32, moving_sphere);
    const test_support::TestFolder folder;
    const auto file = built(folder.path(), field);
    std::set<std::array<std::uint32_t, 4>> active;
    std::uint64_t tested = 0;
    std::uint32_t query_number = 0;
    for (std::uint32_t step = 0; step < 7; ++step)
        for (const double isovalue : {40.0, 100.0, 200.0}) {
            const Query query{{step, kWhole / 3}, isovalue};
            const CellSetPtr set = search_in(file, SearchMethod::bricks, Shading::cells)(query, {});
            tested += set->candidates;
            for (const CellPoint& cell : set->points)
                active.insert({cell.x / 8u, cell.y / 4u, cell.z / 4u, query_number});
            ++query_number;
        }
    constexpr std::size_t kCellsOfBrick = 8 * 4 * 4;
    const double ratio =
        static_cast<double>(tested) / static_cast<double>(active.size() * kCellsOfBrick);
    std::printf("bricks tested over bricks active: %.3f\n", ratio);
    EXPECT_LT(ratio, 1.3);
}

} // namespace
} // namespace isochron::index
