// Files of cell ids: 32 bits, or 64 where a grid has more cells than 32 bits count.
#include "app/commands/id_file.h"
#include "tests/support/test_folder.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <vector>

namespace isochron::app {
namespace {

TEST(IdFile, IdsOfMoreThan32BitsAreWrittenWhole) {
    index::Grid grid;
    grid.vertices = {2001, 3001, 1001}; // 6e9 cells
    index::CellSet set;
    set.points = {{.x = 1, .y = 0, .z = 0, .style = 0, .plane = 0},
                  {.x = 1999, .y = 2999, .z = 999, .style = 0, .plane = 0}};
    const TestFolder folder;
    write_ids(folder.path() / "ids", set, grid);
    const std::string bytes = folder.read("ids");
    std::vector<std::uint64_t> ids(bytes.size() / 8);
    std::memcpy(ids.data(), bytes.data(), ids.size() * 8);
    EXPECT_EQ(bytes.size(), 16u);
    EXPECT_EQ(ids, (std::vector<std::uint64_t>{1, 5'999'999'999}));
}

TEST(IdFile, IdsOf32BitsAreWrittenAsTheyAre) {
    index::Grid grid;
    grid.vertices = {11, 11, 11};
    index::CellSet set;
    set.ids = {7, 999};
    const TestFolder folder;
    write_ids(folder.path() / "ids", set, grid);
    const std::string bytes = folder.read("ids");
    std::vector<std::uint32_t> ids(bytes.size() / 4);
    std::memcpy(ids.data(), bytes.data(), ids.size() * 4);
    EXPECT_EQ(ids, set.ids);
}

} // namespace
} // namespace isochron::app
