// What an extraction takes over, and that it is what it says: colors of vertices, and cells.
#include "index/extraction/extraction.h"
#include "index/indexing/index_build.h"
#include "index/search/layer_search.h"
#include "index/surface/mesh_cases.h"
#include "tests/support/memory_series.h"
#include "tests/support/staying_field.h"
#include "tests/support/test_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <set>

namespace isochron::index {
namespace {

using test_support::TestFolder;

/// A mesh with other colors than those that would be made tells which ones are taken over.
TEST(TakenOver, ColorsOfVerticesAreTakenOverWhereTheyAreSaidToStayAndMadeWhereNot) {
    std::mt19937 random(test_seed());
    const TestFolder folder;
    const TestField values({50, 39, 41}, 1, ValueType::f32, turbulence(random)),
        hue({50, 39, 41}, 1, ValueType::f32, turbulence(random));
    MemorySeries series(values.view()), colors(hue.view());
    colors.info().array = "hue";
    build_index(series, folder.path() / "a.isochron", {.color = &colors});
    for (const std::uint64_t cache : {std::uint64_t{1}, std::uint64_t{1} << 30}) {
        const auto file = IndexFile::open(folder.path() / "a.isochron", cache);
        const StepView step = step_of(*file, Instant(0));
        ASSERT_EQ(step.by_chunks(), cache == 1);
        LayerSearch search(file);
        CellSet set;
        set.query = {{}, quantiles(sorted_values(values.view()), 3)[1]};
        ASSERT_TRUE(search.search(step, set, true, true, {}));
        const ColorSource source(*file, 0);
        CellMesh anew, found;
        ASSERT_TRUE(search.make_mesh(step, set, anew, {}, {&source}));
        ASSERT_EQ(anew.colors.size(), anew.vertices.size());
        CellMesh other = anew;
        for (std::uint16_t& color : other.colors)
            color = static_cast<std::uint16_t>(color ^ 0x8000);
        const CellsOfMesh cells = cells_of(other);
        std::vector<std::uint32_t> places(set.ids.size()), colored;
        for (std::uint32_t i = 0; i < places.size(); ++i) {
            places[i] = random() % 4 ? i : EarlierMesh::kNone;
            colored.push_back(random() % 4 ? places[i] : EarlierMesh::kNone);
        }
        ASSERT_TRUE(search.make_mesh(step, set, found, {}, {&source},
                                     {&other, &cells, places, {}, colored}));
        ASSERT_EQ(found.triangles, anew.triangles);
        ASSERT_EQ(found.vertices, anew.vertices);
        ASSERT_EQ(found.colors.size(), anew.colors.size());
        std::vector<bool> known(anew.vertices.size());
        std::size_t at = 0, taken = 0;
        for (std::size_t cell = 0; cell < set.ids.size(); ++cell)
            for (const std::size_t end = at + 3u * mesh_cases()[anew.cases[cell]].triangles;
                 at < end; ++at) {
                const std::uint32_t vertex = anew.triangles[at];
                if (known[vertex]) // a cell before has it
                    continue;
                known[vertex] = true;
                const bool stays = colored[cell] != EarlierMesh::kNone;
                ASSERT_EQ(found.colors[vertex], (stays ? other : anew).colors[vertex]) << cell;
                taken += stays;
            }
        EXPECT_GT(taken, anew.vertices.size() / 4);
        EXPECT_LT(taken, anew.vertices.size());
    }
}

/// The chunks of a step's grid that are not the same at two steps, value by value.
std::set<std::array<std::uint32_t, 3>> changed_chunks(const StepValues& values, std::uint32_t a,
                                                      std::uint32_t b) {
    std::set<std::array<std::uint32_t, 3>> changed;
    const auto& n = values.grid.vertices;
    const std::size_t size = size_of(values.type);
    const std::byte *at_a = values.step_bytes(a).data(), *at_b = values.step_bytes(b).data();
    for (std::uint32_t z = 0; z < n[2]; ++z)
        for (std::uint32_t y = 0; y < n[1]; ++y)
            for (std::uint32_t x = 0; x < n[0]; ++x, at_a += size, at_b += size)
                if (std::memcmp(at_a, at_b, size) != 0)
                    changed.insert({x / kChunkEdge, y / kChunkEdge, z / kChunkEdge});
    return changed;
}

/// Cells none of whose vertices, nor with normals their neighbors, lies in one of these chunks.
std::size_t cells_without(const std::set<std::array<std::uint32_t, 3>>& chunks, const Grid& grid,
                          const std::vector<CellId>& ids, bool normals) {
    std::vector<std::array<int, 3>> around;
    for (int k = 0; k < 8; ++k) {
        const std::array<int, 3> corner{k & 1, k >> 1 & 1, k >> 2};
        around.push_back(corner);
        for (std::size_t axis = 0; normals && axis < 3; ++axis)
            for (const int step : {-1, 1}) {
                around.push_back(corner);
                around.back()[axis] += step;
            }
    }
    return static_cast<std::size_t>(std::ranges::count_if(ids, [&](CellId id) {
        const auto cell = grid.cell_of(id);
        return std::ranges::none_of(around, [&](const std::array<int, 3>& offset) {
            std::array<std::uint32_t, 3> chunk{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const int at = static_cast<int>(cell[axis]) + offset[axis];
                if (at < 0 || at >= static_cast<int>(grid.vertices[axis]))
                    return false;
                chunk[axis] = static_cast<std::uint32_t>(at) / kChunkEdge;
            }
            return chunks.contains(chunk);
        });
    }));
}

TEST(TakenOver, TellsHowManyCellsWereReused) {
    std::mt19937 random(test_seed());
    const TestFolder folder;
    constexpr std::uint32_t kSteps = 8;
    const TestField field(
        {66, 52, 49}, kSteps, ValueType::i16,
        scaled(staying_field(random, turbulence(random), 0.95, kSteps), 1000, 10));
    const StepValues values = field.view();
    MemorySeries series(values);
    build_index(series, folder.path() / "a.isochron", {.tiers = TierSet().with(Tier::bricks)});
    const double isovalue = quantiles(sorted_values(values), 3)[1];
    for (const std::uint64_t cache : {std::uint64_t{1} << 20, std::uint64_t{1} << 30})
        for (const Shading shading : {Shading::none, Shading::cells}) {
            const Extract extract =
                extract_from(IndexFile::open(folder.path() / "a.isochron", cache), {}, shading);
            std::uint32_t before = 0;
            EXPECT_EQ(extract({Instant(before), {isovalue}}, {})->reused(), 0u);
            for (const std::uint32_t step : {1u, 2u, 3u, 3u, 2u, 3u, 4u, 5u, 6u, 7u, 6u}) {
                const ExtractionPtr found = extract({Instant(step), {isovalue}}, {});
                const std::size_t stay =
                    cells_without(changed_chunks(values, before, step), values.grid,
                                  found->surfaces[0].ids, shading != Shading::none);
                EXPECT_GT(stay, found->cells() / 4);
                EXPECT_EQ(found->reused(), stay) << "step " << step;
                EXPECT_GE(found->candidates(), found->cells());
                before = step;
            }
            // For another isovalue no cell is known.
            EXPECT_EQ(extract({Instant(before), {isovalue + 50}}, {})->reused(), 0u);
        }
}

} // namespace
} // namespace isochron::index
