// Active cells of a step of 2^32 cells, of an index that is nowhere as a whole.
#include "index/error.h"
#include "index/extraction/extraction.h"
#include "index/file/color_source.h"
#include "index/indexing/index_build.h"
#include "index/search/index_search.h"
#include "index/search/layer_search.h"
#include "index/surface/cell_colors.h"
#include "tests/support/huge_index.h"
#include "tests/support/memory_series.h"
#include "tests/support/test_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <string>

namespace isochron::index {
namespace {

/// Cells about the chunks of the high value.
std::vector<std::uint64_t> active_slowly(const Grid& grid, const std::set<ChunkAt>& high) {
    const auto cells = grid.cells();
    std::set<std::uint64_t> active;
    for (const ChunkAt& chunk : high) {
        std::array<std::uint32_t, 3> first{}, end{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            first[axis] = std::max(chunk[axis] * kChunkEdge, 1u) - 1;
            end[axis] = std::min((chunk[axis] + 1) * kChunkEdge, cells[axis]);
        }
        for (std::uint32_t z = first[2]; z < end[2]; ++z)
            for (std::uint32_t y = first[1]; y < end[1]; ++y)
                for (std::uint32_t x = first[0]; x < end[0]; ++x) {
                    unsigned above = 0;
                    for (unsigned d = 0; d < 8; ++d)
                        above += HugeIndex::value(high, x + (d & 1), y + (d >> 1 & 1),
                                                  z + (d >> 2)) > 150;
                    if (above > 0 && above < 8)
                        active.insert(std::uint64_t{x} +
                                      cells[0] * (y + std::uint64_t{cells[1]} * z));
                }
    }
    return {active.begin(), active.end()};
}

std::vector<std::uint64_t> wide_ids_of(const CellSet& set, const Grid& grid) {
    std::vector<std::uint64_t> ids;
    for (const CellPoint& point : set.points)
        ids.push_back(wide_id(grid, point.x, point.y, point.z));
    return ids;
}

TEST(WideIds, OfAStepOf2To32CellsAreAllFoundInTheirPlaces) {
    Grid grid;
    grid.vertices = {257, 257, 65537};
    ASSERT_TRUE(has_wide_ids(grid));
    const std::set<ChunkAt> high{{0, 0, 0},      {5, 7, 2047},  {5, 7, 2048},  {6, 7, 2048},
                                 {15, 15, 4095}, {16, 3, 4096}, {16, 16, 4090}};
    const auto file = IndexFile::open(std::make_unique<HugeIndex>(grid, high));
    const auto expected = active_slowly(grid, high);
    EXPECT_GT(expected.back(), 0xffff'0000u);
    const Query query{Instant(0), 150};
    const CellSetPtr found = search_in(file)(query, {});
    EXPECT_EQ(found->method, SearchMethod::bricks);
    EXPECT_EQ(wide_ids_of(*found, grid), expected);
    EXPECT_EQ(wide_ids_of(search_level(file, 0, query), grid), expected);
    EXPECT_TRUE(search_in(file)({Instant(0), 250}, {})->ids.empty());
}

/// Chunks near the corner from which a volume starts, before and behind where ids of 32 bits begin
/// anew in a grid of 2049^3 vertices.
const std::set<ChunkAt> kBeforeAndBehind{{1, 1, 1},  {2, 2, 1},   {1, 2, 62},  {1, 1, 63},
                                         {2, 1, 64}, {2, 2, 100}, {1, 2, 126}, {2, 2, 126}};

std::shared_ptr<const IndexFile> step_of(std::uint32_t width, std::uint32_t height) {
    Grid grid;
    grid.vertices = {width, height, 2049};
    return IndexFile::open(std::make_unique<HugeIndex>(grid, kBeforeAndBehind));
}

/// Places of volume bricks, which have other numbers in other grids.
std::vector<std::array<std::uint32_t, 3>> places_of(const VolumeBlocks& bricks, const Grid& grid) {
    const auto tiles = BlockTiling(grid).blocks;
    std::vector<std::array<std::uint32_t, 3>> places;
    for (const BlockId id : bricks.ids)
        places.push_back({id % tiles[0], id / tiles[0] % tiles[1], id / tiles[0] / tiles[1]});
    return places;
}

TEST(WideIds, AreExtractedAsTheSameCellsOfAGridWithoutThem) {
    const auto wide = step_of(2049, 2049), narrow = step_of(65, 65);
    const Grid &wide_grid = wide->info().grid, &narrow_grid = narrow->info().grid;
    ASSERT_TRUE(has_wide_ids(wide_grid));
    ASSERT_FALSE(has_wide_ids(narrow_grid));
    SurfacesQuery query;
    query.isovalues = {150, 120};
    query.mesh_room = std::uint64_t{1} << 30;
    const ExtractionPtr found = extract_from(wide, std::nullopt, Shading::none)(query, {});
    const ExtractionPtr expected = extract_from(narrow, std::nullopt, Shading::cells)(query, {});
    ASSERT_EQ(found->surfaces.size(), 2u);
    EXPECT_TRUE(found->shaded()) << "renderers cannot tell places by these ids";
    for (std::size_t i = 0; i < 2; ++i) {
        const CellSet &cells = found->surfaces[i], &same = expected->surfaces[i];
        ASSERT_GT(same.points.size(), 4000u);
        EXPECT_FALSE(std::ranges::is_sorted(cells.ids));
        const auto bytes = [](const CellSet& set) {
            const auto all = std::as_bytes(std::span(set.points));
            return std::vector<std::byte>(all.begin(), all.end());
        };
        EXPECT_EQ(bytes(cells), bytes(same));
        ASSERT_TRUE(cells.mesh && same.mesh);
        EXPECT_EQ(*cells.mesh, *same.mesh);
    }
    EXPECT_EQ(places_of(found->blocks, wide_grid), places_of(expected->blocks, narrow_grid));
    EXPECT_EQ(found->blocks.joined(), expected->blocks.joined());
    EXPECT_EQ(found->volume_cells, expected->volume_cells);
}

TEST(WideIds, OfFirstCrossingsHaveNoColor) {
    SurfacesQuery query;
    query.isovalues = {150};
    query.coloring = CellColoring::first_crossing;
    const ExtractionPtr found = extract_from(step_of(2049, 2049))(query, {});
    ASSERT_GT(found->cells(), 4000u);
    EXPECT_EQ(found->colors, std::vector<std::uint16_t>(found->cells(), kNoColor));
}

TEST(WideIds, OfASurfaceAreColoredAsTheSameCellsOfAGridWithoutThem) {
    const auto colors = [](const std::shared_ptr<const IndexFile>& file) {
        const CellSetPtr set = search_in(file)({Instant(0), 150}, {});
        std::vector<std::uint16_t> out(set->ids.size(), kNoColor);
        const ColorSource by_own_values(*file, 0);
        EXPECT_TRUE(LayerSearch(file).color_cells(step_in_chunks(*file, Instant(0)), *set,
                                                  by_own_values, out, {}));
        return out;
    };
    const auto found = colors(step_of(2049, 2049));
    EXPECT_EQ(found, colors(step_of(65, 65)));
    EXPECT_EQ(std::ranges::count(found, kNoColor), 0);
}

TEST(WideIds, AreCountedWithoutBeingKept) {
    const auto file = step_of(2049, 2049);
    const Query query{Instant(0), 150};
    const StepView step = step_in_chunks(*file, Instant(0));
    EXPECT_EQ(LayerSearch(file).count(step, query, true, {}),
              search_in(file)(query, {})->ids.size());
    EXPECT_EQ(LayerSearch(file).count(step, {Instant(0), 250}, true, {}), 0u);
}

TEST(WideIds, WhatTellsCellsApartBy32BitsRefusesThemBeforeAnythingIsRead) {
    test_support::TestFolder folder;
    StepValues values{.grid = {.vertices = {2048, 2048, 2048}},
                      .type = ValueType::u8,
                      .scaling = {},
                      .steps = 1,
                      .first = nullptr,
                      .stride = 0};
    MemorySeries series(values);
    series.before_read = [](std::size_t) { FAIL() << "read"; };
    const auto refusal = [&](const BuildOptions& options) -> std::string {
        try {
            build_index(series, folder.path() / "a.isochron", options);
        } catch (const Error& error) {
            return error.what();
        }
        return "none";
    };
    const std::string cells = "t0.raw: 8577357823 cells, expected fewer than 2^32 for ";
    BuildOptions referring;
    referring.referral.emplace();
    EXPECT_EQ(refusal(referring), cells + "an index that refers to its sources");
    EXPECT_EQ(refusal({.with_tree = true}), cells + "the tier tree");
    EXPECT_EQ(refusal({.tiers = TierSet().with(Tier::tree)}), cells + "the tier tree");
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(WideIds, ReachBeyond32Bits) {
    Grid grid;
    grid.vertices = {2048, 2048, 2048};
    EXPECT_TRUE(has_wide_ids(grid));
    EXPECT_EQ(wide_id(grid, 2046, 2046, 2046), 2047ull * 2047 * 2047 - 1);
    grid.vertices = {65536, 65538, 2};
    EXPECT_EQ(grid.cell_count(), 65535ull * 65537);
    EXPECT_FALSE(has_wide_ids(grid)) << "2^32 - 1 cells";
}

} // namespace
} // namespace isochron::index
