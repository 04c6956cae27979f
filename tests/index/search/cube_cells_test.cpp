// What cells of a chunk need around it, and how many a search of chunks tests.
#include "index/indexing/index_build.h"
#include "index/scan/bricks.h"
#include "index/search/cube_cells.h"
#include "index/search/index_search.h"
#include "tests/support/memory_series.h"
#include "tests/support/reader_fixtures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

namespace isochron::index {
namespace {

/// By walking over the vertices of a cell and those next to them along each axis.
ChunksAround around_by_vertices(const std::array<int, 3>& cell, bool normals) {
    ChunksAround around = 0;
    const auto reach = [&](const std::array<int, 3>& vertex) {
        const auto of = [](int v) { return v < 0 ? 0 : v < int{kChunkEdge} ? 1 : 2; };
        around |= 1u << (of(vertex[0]) + 3 * of(vertex[1]) + 9 * of(vertex[2]));
    };
    for (int corner = 0; corner < 8; ++corner) {
        std::array<int, 3> vertex = cell;
        for (int axis = 0; axis < 3; ++axis)
            vertex[axis] += corner >> axis & 1;
        reach(vertex);
        for (int axis = 0; normals && axis < 3; ++axis)
            for (const int step : {-1, 1}) {
                std::array<int, 3> next = vertex;
                next[axis] += step;
                reach(next);
            }
    }
    return around;
}

TEST(CubeCells, NeedTheChunksThatHoldTheirVerticesAndTheNextOnes) {
    std::mt19937 random(test_seed());
    for (int round = 0; round < 500; ++round) {
        CubeRows rows{};
        std::array<ChunksAround, 2> wanted{};
        std::vector<PlaceInChunk> places, found;
        for (std::size_t cells = 1 + random() % 3; cells > 0; --cells)
            places.push_back(static_cast<PlaceInChunk>(random() % 4096));
        std::ranges::sort(places);
        places.erase(std::unique(places.begin(), places.end()), places.end());
        for (const PlaceInChunk place : places) {
            rows[place / kChunkEdge] =
                static_cast<std::uint16_t>(rows[place / kChunkEdge] | 1u << place % kChunkEdge);
            const std::array<int, 3> cell{place % 16, place / 16 % 16, place / 256};
            for (const bool normals : {false, true})
                wanted[normals] |= around_by_vertices(cell, normals);
        }
        for (const bool normals : {false, true})
            ASSERT_EQ(chunks_around(sides_of(rows), normals), wanted[normals]);
        ASSERT_EQ(append_places(rows, found), places.size());
        ASSERT_EQ(found, places);
    }
}

TEST(CubeCells, AsManyAreTestedAsInTheWholeStep) {
    const test_support::TestFolder folder;
    const auto path = folder.path() / "a.isochron";
    for (const std::array<std::uint32_t, 3> vertices :
         {std::array{45u, 38u, 50u}, {49u, 33u, 34u}}) {
        const TestField field(vertices, 1, ValueType::u8, moving_sphere);
        MemorySeries series(field.view());
        build_index(series, path, {.tiers = TierSet().with(Tier::bricks)});
        const auto file = IndexFile::open(path, 1); // so that no step is worked on as a whole
        const Query query{Instant(0), 100};
        const CellSetPtr set = search_in(file, SearchMethod::bricks)(query, {});
        const LoadedStep step = file->load(0);
        std::vector<CellId> ids;
        EXPECT_EQ(set->candidates,
                  test_bricks(step.values, *file->chunks().levels(0), step.bricks, query, ids));
        EXPECT_EQ(set->ids.size(), ids.size());
        EXPECT_GT(set->candidates, ids.size());
    }
}

} // namespace
} // namespace isochron::index
