// How many cells fit into the memory that the program may use.
#include "app/quality/cell_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace isochron::app {
namespace {

using testing::HasSubstr;

constexpr std::uint64_t kMiB = 1 << 20;

TEST(CellRoom, GrowsWithTheMemoryAndIsNeverNothing) {
    EXPECT_EQ(cells_in_memory(768 * kMiB, 192 * kMiB), 176 * kMiB / 300);
    EXPECT_GT(cells_in_memory(4096 * kMiB, 1024 * kMiB), 8'000'000u);
    EXPECT_EQ(cells_in_memory(100 * kMiB, 25 * kMiB), 65536u);
}

TEST(CellRoom, LimitsAChoiceWithALineWhereAVolumeMayHaveMoreCells) {
    index::Grid grid;
    grid.vertices = {320, 320, 320};
    DetailChooser small(grid, 8'000'000), large(grid, 8'000'000);
    const auto line = limit_to_memory(small, grid.cell_count(), 768 * kMiB, 192 * kMiB);
    ASSERT_TRUE(line);
    EXPECT_THAT(*line, HasSubstr("surfaces of more than 615164 cells"));
    EXPECT_THAT(*line, HasSubstr("768 MiB"));
    EXPECT_EQ(small.most(), 615'164u);
    EXPECT_EQ(small.at_rest().most_cells, 615'164u);
    EXPECT_FALSE(limit_to_memory(large, grid.cell_count(), 16384 * kMiB, 4096 * kMiB));
    EXPECT_EQ(large.most(), 8'000'000u);
    // A volume that cannot have so many cells is never limited.
    EXPECT_FALSE(limit_to_memory(large, 600'000, 768 * kMiB, 192 * kMiB));
}

} // namespace
} // namespace isochron::app
