// Extractions: the cells of every surface, and all of the volume that they need.
#include "index/error.h"
#include "index/extraction/extractor.h"
#include "index/surface/cell_colors.h"
#include "tests/support/indexed.h"
#include "tests/support/memory_series.h"
#include "tests/support/test_field.h"
#include "tests/support/test_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace isochron::index {
namespace {

using test_support::TestFolder;

/// Blocks of all vertices whose values a cell's central differences take, one by one.
std::set<BlockId> needed(const Grid& grid, const std::vector<CellSet>& surfaces) {
    const BlockTiling tiling(grid);
    std::set<BlockId> blocks;
    const auto need = [&](std::array<std::uint32_t, 3> v) {
        for (std::uint32_t& along : v)
            along /= kBlockEdge;
        blocks.insert((v[2] * tiling.blocks[1] + v[1]) * tiling.blocks[0] + v[0]);
    };
    for (const CellSet& surface : surfaces)
        for (const CellId id : surface.ids) {
            const auto at = grid.cell_of(id);
            for (std::uint32_t c = 0; c < 8; ++c) {
                const std::array<std::uint32_t, 3> v{at[0] + (c & 1), at[1] + (c >> 1 & 1),
                                                     at[2] + (c >> 2)};
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    auto low = v, high = v;
                    low[axis] -= low[axis] > 0;
                    high[axis] += high[axis] + 1 < grid.vertices[axis];
                    need(low);
                    need(high);
                }
            }
        }
    return blocks;
}

TEST(Extraction, HasTheCellsOfEverySurfaceAndExactlyTheBlocksTheyNeed) {
    const TestFolder folder;
    std::mt19937 random(test_seed());
    for (const ValueType type : kAllTypes) {
        const TestField field({26, 17, 33}, 3, type, scaled(turbulence(random), 100, 10));
        const StepValues values = field.view();
        const Extract extract = extract_from(indexed(folder, values));
        const auto isovalues = quantiles(sorted_values(values), 9);
        for (const std::size_t surfaces : {1, 3, 8})
            for (std::uint32_t step = 0; step < 3; ++step) {
                SurfacesQuery query{Instant(step), {}};
                while (query.isovalues.size() < surfaces)
                    query.isovalues.push_back(isovalues[random() % isovalues.size()]);
                const ExtractionPtr found = extract(query, {});
                ASSERT_TRUE(found);
                EXPECT_EQ(found->query, query);
                ASSERT_EQ(found->surfaces.size(), surfaces);
                for (std::size_t i = 0; i < surfaces; ++i)
                    ASSERT_EQ(found->surfaces[i].ids,
                              BruteForce(values, step).active(query.isovalues[i]))
                        << name_of(type) << " surface " << i;
                const auto blocks = needed(values.grid, found->surfaces);
                EXPECT_EQ(found->blocks.ids, (std::vector<BlockId>(blocks.begin(), blocks.end())));
                EXPECT_EQ(found->blocks.bytes(), blocks.size() * found->blocks.block_bytes());
            }
    }
}

/// A volume, another array of other values, and the index of both.
class ColoredExtraction : public testing::Test {
  protected:
    static constexpr std::uint32_t kSteps = 4;
    ColoredExtraction() {
        MemorySeries volume(volume_.view()), colors(colors_.view());
        for (MemorySeries* series : {&volume, &colors})
            series->info().times = kTimes;
        build_index(volume, folder_.path() / "a.isochron", {.color = &colors});
        file_ = IndexFile::open(folder_.path() / "a.isochron");
    }

    /// By brute force: the search for the earliest step is a search through all of them.
    std::vector<std::uint16_t> first_crossings_of(const SurfacesQuery& query) const {
        std::vector<std::uint16_t> colors;
        for (const double isovalue : query.isovalues) {
            std::vector<std::vector<CellId>> active;
            for (std::uint32_t step = 0; step < kSteps; ++step)
                active.push_back(BruteForce(volume_.view(), step).active(isovalue));
            for (const CellId id : active[query.instant.step]) {
                std::size_t first = 0;
                while (!std::ranges::binary_search(active[first], id))
                    ++first;
                colors.push_back(color_coordinate(kTimes[first], kTimes.front(), kTimes.back()));
            }
        }
        return colors;
    }
    std::vector<std::uint16_t> values_of(const SurfacesQuery& query) const {
        const auto sorted = sorted_values(colors_.view());
        std::vector<std::uint16_t> colors;
        for (std::size_t i = 0; i < query.isovalues.size(); ++i) {
            const auto cells =
                BruteForce(volume_.view(), query.instant.step).active(query.isovalues[i]);
            std::vector<std::uint16_t> part(cells.size());
            color_cells(volume_.view(), colors_.view(), query.surface(i), cells, sorted.front(),
                        sorted.back(), part);
            colors.insert(colors.end(), part.begin(), part.end());
        }
        return colors;
    }

    inline static const std::vector<double> kTimes{2, 3, 7, 12};
    TestFolder folder_;
    std::mt19937 random_{test_seed()};
    TestField volume_{{21, 15, 12}, kSteps, ValueType::f32, turbulence(random_)};
    TestField colors_{
        {21, 15, 12}, kSteps, ValueType::i16, scaled(turbulence(random_), 900, 40), {0.5, 10}};
    std::shared_ptr<const IndexFile> file_;
};

TEST_F(ColoredExtraction, HasTheColorsOfBruteForceForEverySurface) {
    const Extract extract = extract_from(file_);
    for (int round = 0; round < 40; ++round) {
        SurfacesQuery query{Instant(std::uint32_t(random_() % kSteps)), {}};
        for (auto n = 1 + random_() % 3; n > 0; --n) // one of them has no cells
            query.isovalues.push_back(std::array{-0.2, 0.0, 0.1, 0.4, 9.0}[random_() % 5]);
        query.coloring = CellColoring(random_() % 3);
        const ExtractionPtr found = extract(query, {});
        ASSERT_TRUE(found);
        EXPECT_EQ(found->query, query);
        switch (query.coloring) {
        case CellColoring::none: EXPECT_TRUE(found->colors.empty()); break;
        case CellColoring::value: EXPECT_EQ(found->colors, values_of(query)); break;
        case CellColoring::first_crossing:
            EXPECT_EQ(found->colors, first_crossings_of(query));
            break;
        }
    }
}

TEST_F(ColoredExtraction, AChangeOfColoringIsANewQueryAlsoForThePrefetch) {
    Extractor extractor(extract_from(file_));
    for (const CellColoring coloring :
         {CellColoring::none, CellColoring::value, CellColoring::first_crossing}) {
        for (const std::uint32_t step : {0u, 1u}) {
            const SurfacesQuery query{Instant(step), {0.1}, coloring};
            extractor.request({.query = query, .ahead = StepsAhead{step + 1}});
            extractor.wait();
            EXPECT_EQ(extractor.newest()->query, query);
        }
    }
}

TEST_F(ColoredExtraction, AStoppedSweepGivesNothingAndTheNextIsWhole) {
    const Extract extract = extract_from(file_);
    const SurfacesQuery query{Instant(1), {0.0, 0.4}, CellColoring::first_crossing};
    std::stop_source stop;
    stop.request_stop();
    EXPECT_EQ(extract(query, stop.get_token()), nullptr);
    EXPECT_EQ(extract(query, {})->colors, first_crossings_of(query));
}

TEST(Extraction, WithoutASecondArrayThereAreNoValuesToColorBy) {
    const TestFolder folder;
    const TestField field({9, 9, 9}, 1, ValueType::u8, moving_sphere);
    const Extract extract = extract_from(indexed(folder, field.view()));
    const double middle = quantiles(sorted_values(field.view()), 3)[1];
    const auto found = extract({Instant(0), {middle}, CellColoring::value}, {});
    ASSERT_GT(found->cells(), 0u);
    EXPECT_TRUE(found->colors.empty());
}

TEST(Extraction, BlocksHoldTheVolumeByteForByteAndZerosBeyondIt) {
    const TestFolder folder;
    std::mt19937 random(test_seed());
    const TestField field({19, 11, 10}, 2, ValueType::i16, scaled(white_noise(random), 900, 10));
    const StepValues values = field.view();
    const ExtractionPtr found = extract_from(indexed(folder, values))({Instant(1), {10.0}}, {});
    const BlockTiling tiling(values.grid);
    ASSERT_EQ(found->blocks.held, ValueType::i16);
    ASSERT_EQ(found->blocks.ids.size(), tiling.count());
    for (std::size_t i = 0; i < found->blocks.ids.size(); ++i) {
        const BlockId id = found->blocks.ids[i];
        const auto* held = reinterpret_cast<const std::int16_t*>(found->blocks.block(i).data());
        for (std::uint32_t v = 0; v < kBlockVertices; ++v) {
            const std::uint32_t x = id % tiling.blocks[0] * 8 + v % 8;
            const std::uint32_t y = id / tiling.blocks[0] % tiling.blocks[1] * 8 + v / 8 % 8;
            const std::uint32_t z = id / tiling.blocks[0] / tiling.blocks[1] * 8 + v / 64;
            const bool inside = x < 19 && y < 11 && z < 10;
            ASSERT_EQ(held[v], inside ? values.step<std::int16_t>(1)[(z * 11 + y) * 19 + x] : 0);
        }
    }
}

TEST(Extraction, DigestsTellBlocksThatChangeFromThoseThatDoNot) {
    const TestFolder folder;
    const TestField field(
        {32, 20, 20}, 3, ValueType::f32, [](double x, double y, double z, double t) {
            return x + y + z + (x >= 16 && t > 0 ? 0.25 : 0.0); // changes once, in one half
        });
    const Extract extract = extract_from(indexed(folder, field.view()));
    const auto first = extract({Instant(0), {30.0}}, {}),
               second = extract({Instant(1), {30.0}}, {}),
               third = extract({Instant(2), {30.0}}, {}), other = extract({Instant(2), {34.0}}, {});
    std::size_t same = 0, changed = 0;
    for (std::size_t i = 0; i < second->blocks.ids.size(); ++i) {
        const auto at = std::ranges::find(first->blocks.ids, second->blocks.ids[i]);
        if (at == first->blocks.ids.end())
            continue;
        const bool equal = first->blocks.digests[std::size_t(at - first->blocks.ids.begin())] ==
                           second->blocks.digests[i];
        EXPECT_EQ(equal, second->blocks.ids[i] % 4 < 2);
        (equal ? same : changed) += 1;
    }
    EXPECT_GT(same, 5u);
    EXPECT_GT(changed, 5u);
    EXPECT_EQ(second->blocks.digests, third->blocks.digests);
    for (std::size_t i = 0; i < other->blocks.ids.size(); ++i) { // another isovalue, the same step
        const auto at = std::ranges::find(third->blocks.ids, other->blocks.ids[i]);
        if (at != third->blocks.ids.end()) {
            EXPECT_EQ(third->blocks.digests[std::size_t(at - third->blocks.ids.begin())],
                      other->blocks.digests[i]);
        }
    }
}

TEST(Extraction, MeshesOfAllSurfacesComeWithinTheirRoomOrNot) {
    const TestFolder folder;
    const TestField field({20, 20, 20}, 2, ValueType::f32, moving_sphere);
    const auto file = indexed(folder, field.view());
    const Extract extract = extract_from(file, std::nullopt, Shading::cells);
    const auto asked = [&](std::uint64_t room) {
        return extract({.instant = Instant(0), .isovalues = {30.0, 60.0, 1e9}, .mesh_room = room},
                       {});
    };
    EXPECT_FALSE(asked(0)->surfaces[0].mesh) << "nobody has asked";
    const auto all = asked(std::uint64_t{1} << 30);
    ASSERT_TRUE(all->meshed());
    const std::uint64_t bytes = bytes_of(*all->surfaces[0].mesh) + bytes_of(*all->surfaces[1].mesh);
    EXPECT_GE(bytes, least_mesh_bytes(all->cells()));
    EXPECT_TRUE(asked(bytes)->meshed());
    const auto without = asked(bytes - 1);
    EXPECT_FALSE(without->meshed());
    for (const CellSet& surface : without->surfaces)
        EXPECT_FALSE(surface.mesh);
    EXPECT_EQ(without->cells(), all->cells());
    EXPECT_EQ(extract_from(file)({.isovalues = {30.0}, .mesh_room = bytes}, {})->surfaces[0].mesh,
              nullptr)
        << "a GPU makes its own normals, and draws no mesh";
}

TEST(Extraction, WithoutActiveCellsThereIsNothingToSend) {
    const TestFolder folder;
    const TestField field({9, 9, 9}, 1, ValueType::u8, moving_sphere);
    const Extract extract = extract_from(indexed(folder, field.view()));
    const auto found = extract({Instant(0), {1e9, std::nan("")}}, {});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->cells(), 0u);
    EXPECT_TRUE(found->blocks.ids.empty());
    EXPECT_EQ(found->blocks.held, ValueType::u8);
}

TEST(Extraction, AStoppedOneGivesNothingAndTheNextIsWhole) {
    const TestFolder folder;
    const TestField field({40, 40, 40}, 2, ValueType::f32, moving_sphere);
    const Extract extract = extract_from(indexed(folder, field.view()));
    std::stop_source stop;
    stop.request_stop();
    EXPECT_EQ(extract({Instant(1), {100.0, 150.0}}, stop.get_token()), nullptr);
    const auto found = extract({Instant(1), {100.0, 150.0}}, {});
    const auto blocks = needed(field.view().grid, found->surfaces);
    EXPECT_EQ(found->blocks.ids, (std::vector<BlockId>(blocks.begin(), blocks.end())));
}

TEST(Extraction, WhatCannotBeAskedIsAnError) {
    const TestFolder folder;
    const TestField field({9, 9, 9}, 2, ValueType::u8, moving_sphere);
    const Extract extract = extract_from(indexed(folder, field.view()));
    EXPECT_THROW(extract({Instant(2), {1.0}}, {}), Error);
    EXPECT_THROW(extract({Instant(0), {}}, {}), Error);
    EXPECT_THROW(extract({Instant(0), std::vector<double>(kMostSurfaces + 1, 1.0)}, {}), Error);
}

/// A worker that extracts while others look: what is published does not change any more.
TEST(Extraction, IsMadeByTheWorkerAndReadByOthers) {
    const TestFolder folder;
    const TestField field({24, 24, 24}, 6, ValueType::u8, moving_sphere);
    Extractor extractor(extract_from(indexed(folder, field.view())));
    for (std::uint32_t i = 0; i < 60; ++i) {
        extractor.request(
            {.query = {Instant(i % 6), {100.0, 150.0 + i % 3}}, .ahead = StepsAhead{(i + 1) % 6}});
        if (const ExtractionPtr newest = extractor.newest()) {
            ASSERT_EQ(newest->surfaces.size(), 2u);
            ASSERT_EQ(newest->blocks.digests.size(), newest->blocks.ids.size());
        }
        if (i % 4 == 0)
            extractor.wait();
    }
    extractor.wait();
    EXPECT_EQ(extractor.newest()->query.instant, Instant(5));
}

} // namespace
} // namespace isochron::index
