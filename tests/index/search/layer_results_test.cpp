// Results of layers are joined in the order of the layers, until it is asked to stop.
#include "index/search/layer_results.h"

#include <gtest/gtest.h>

#include <numeric>

namespace isochron::index {
namespace {

constexpr CellId kCells = 100'000; ///< cells of each layer; more than are appended at a time

/// One row of cells with ids from 0 on, in a layer whose first cell has that id.
LayerResult layer_from(CellId first, std::uint32_t first_plane) {
    LayerResult result;
    result.first = first;
    result.first_plane = first_plane;
    result.cells.ids.resize(kCells);
    std::iota(result.cells.ids.begin(), result.cells.ids.end(), CellId{0});
    result.cells.points.resize(kCells, {.x = 3, .y = 4, .z = 1, .style = 0, .plane = 5});
    result.cells.rows = {{.y = 4, .z = 1, .begin = 0}};
    result.cells.candidates = kCells + 1;
    return result;
}

TEST(LayerResults, AreJoinedInTheOrderOfLayersWhateverOrderTheyComeIn) {
    CellSet set;
    set.ids = {7}; // what an earlier search found
    LayerResults results(set, 3, {});
    for (const std::uint32_t layer : {2u, 0u, 1u})
        results.add(layer, layer_from(layer * kCells, 16 * layer));
    ASSERT_EQ(set.ids.size(), 3 * kCells);
    ASSERT_EQ(set.points.size(), 3 * kCells);
    for (CellId i = 0; i < 3 * kCells; ++i) {
        ASSERT_EQ(set.ids[i], i);
        ASSERT_EQ(set.points[i].z, 1 + 16 * (i / kCells));
        ASSERT_EQ(set.points[i].plane, 5u);
    }
    ASSERT_EQ(set.rows.size(), 3u);
    for (std::uint32_t layer = 0; layer < 3; ++layer) {
        EXPECT_EQ(set.rows[layer].z, 1 + 16 * layer);
        EXPECT_EQ(set.rows[layer].begin, layer * kCells);
    }
    EXPECT_EQ(set.candidates, 3u * (kCells + 1));
    EXPECT_EQ(results.cells, 3u * kCells);
}

TEST(LayerResults, AreNotKeptOnceItIsAskedToStop) {
    CellSet set;
    std::stop_source stop;
    LayerResults results(set, 2, stop.get_token());
    results.add(0, layer_from(0, 0));
    EXPECT_EQ(set.ids.size(), kCells);
    stop.request_stop();
    results.add(1, layer_from(kCells, 16));
    EXPECT_EQ(set.ids.size(), kCells);
    EXPECT_EQ(set.points.size(), kCells);
}

} // namespace
} // namespace isochron::index
