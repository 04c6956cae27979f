// Blocks with active cells and the cache lines of their values, beside a count cell by cell.
#include "tests/bench/measures/touched_lines.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace isochron::bench {
namespace {

TEST(TouchedLines, AreThoseOfAllVerticesOfBlocksWithAnActiveCell) {
    std::mt19937 random(7);
    const index::Grid grid{.vertices = {37, 11, 9}};
    constexpr std::array<std::uint32_t, 3> kEdges{8, 4, 2};
    std::vector<index::CellId> ids;
    for (index::CellId id = 0; id < grid.cell_count(); ++id)
        if (random() % 97 == 0)
            ids.push_back(id);
    std::set<std::array<std::uint32_t, 3>> blocks;
    std::set<std::size_t> lines;
    const auto block_of = [&](index::CellId id) {
        const auto [x, y, z] = grid.cell_of(id);
        return std::array{x / kEdges[0], y / kEdges[1], z / kEdges[2]};
    };
    for (const index::CellId id : ids)
        blocks.insert(block_of(id));
    for (index::CellId id = 0; id < grid.cell_count(); ++id)
        if (blocks.contains(block_of(id))) {
            const auto [x, y, z] = grid.cell_of(id);
            for (std::size_t corner = 0; corner < 8; ++corner) {
                const std::size_t vertex =
                    ((z + corner / 4) * 11 + y + corner / 2 % 2) * 37 + x + corner % 2;
                lines.insert(vertex * 4 / 64);
            }
        }
    const TouchedBlocks touched = touched_blocks(ids, grid, kEdges, 4);
    EXPECT_EQ(touched.blocks, 5u * 3 * 4);
    EXPECT_EQ(touched.held, blocks.size());
    EXPECT_LT(touched.held, touched.blocks);
    EXPECT_EQ(touched.bytes, 64 * lines.size());
}

} // namespace
} // namespace isochron::bench
