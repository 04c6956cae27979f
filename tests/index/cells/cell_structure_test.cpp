// Stored cells: entries are at the highest time nodes over which cells are constant, and take few
// bytes.
#include "tests/index/cells/cell_series.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace isochron::index {
namespace {

/// Entries of every time node, by the definition: cell by cell, from the steps up. A node at which
/// fewer than 512 would be entries leaves them to those below.
struct ExpectedEntries {
    const StretchRanks& ranks;
    std::vector<std::uint32_t> counts;

    explicit ExpectedEntries(const StretchRanks& of)
        : ranks(of), counts(TimeNode::count(of.steps())) {
        count(TimeNode::root(ranks.steps()), visit(TimeNode::root(ranks.steps())));
    }

  private:
    using Cells = std::vector<std::uint32_t>;

    bool active(const TimeNode& node, std::uint32_t cell) const {
        return ranks.at(node.first).low[cell] < ranks.at(node.first).high[cell];
    }
    bool alike(const TimeNode& a, const TimeNode& b, std::uint32_t cell) const {
        return ranks.at(a.first).low[cell] == ranks.at(b.first).low[cell] &&
               ranks.at(a.first).high[cell] == ranks.at(b.first).high[cell];
    }
    void count(const TimeNode& node, const Cells& cells) {
        for (const std::uint32_t cell : cells)
            counts[node.number] += active(node, cell);
    }
    /// The cells that may be entries of the node or of one above, ascending.
    Cells visit(const TimeNode& node) {
        Cells cells;
        if (node.is_leaf()) {
            cells.resize(ranks.cells());
            std::iota(cells.begin(), cells.end(), 0u);
            return cells;
        }
        const TimeNode left = node.left(), right = node.right();
        const Cells in_left = visit(left), in_right = visit(right);
        std::set_intersection(in_left.begin(), in_left.end(), in_right.begin(), in_right.end(),
                              std::back_inserter(cells));
        std::erase_if(cells, [&](std::uint32_t cell) { return !alike(left, right, cell); });
        if (std::count_if(cells.begin(), cells.end(),
                          [&](std::uint32_t cell) { return active(node, cell); }) < 512)
            cells.clear();
        for (const auto& [child, all] : {std::pair(left, in_left), std::pair(right, in_right)}) {
            Cells rest;
            std::set_difference(all.begin(), all.end(), cells.begin(), cells.end(),
                                std::back_inserter(rest));
            count(child, rest);
        }
        return cells;
    }
};

TEST(CellUnit, StoresACellAtTheHighestNodesOverWhichItAndEnoughOthersAreConstant) {
    for (const std::size_t steps : {1, 6, 19}) {
        const TestField field({45, 40, 41}, steps, ValueType::u8, moving_sphere);
        const LevelMap levels = LevelMap::of_type(ValueType::u8);
        const CellSeries series(field.view(), levels);
        StretchRanks ranks(field.view(), levels);
        for (std::uint32_t stretch = 0; stretch < Stretches(field.view().grid).count(); ++stretch) {
            ranks.compute(stretch, 0, static_cast<std::uint32_t>(steps));
            EXPECT_EQ(CellUnit(series.cells[stretch], 0).entries(), ExpectedEntries(ranks).counts);
        }
    }
}

TEST(StretchRanks, AreTheRanksOfTheExtremes) {
    std::mt19937 random(test_seed());
    const TestField field({130, 60, 19}, 3, ValueType::i16, scaled(turbulence(random), 90, 0));
    const StepValues values = field.view();
    std::vector<std::uint64_t> thresholds;
    for (std::uint64_t k = 0; k < 180; k += 3)
        thresholds.push_back(32768 - 90 + k);
    const LevelMap levels = LevelMap::of_thresholds(ValueType::i16, thresholds);
    const Stretches stretches(values.grid);
    ASSERT_GE(stretches.count(), 3u);
    StretchRanks ranks(values, levels);
    for (std::uint32_t stretch = 0; stretch < stretches.count(); ++stretch) {
        ranks.compute(stretch, 1, 2);
        ASSERT_EQ(ranks.cells(), stretches.cells(stretch));
        for (std::uint32_t step = 0; step < 2; ++step) {
            std::vector<std::uint8_t> of_vertices(values.grid.vertex_count());
            levels.ranks(std::as_bytes(values.step<std::int16_t>(step + 1)), of_vertices);
            for (std::uint32_t cell = 0; cell < ranks.cells(); ++cell) {
                const auto [x, y, z] = values.grid.cell_of(stretches.first_cell(stretch) + cell);
                std::uint8_t low = 255, high = 0;
                for (std::size_t corner = 0; corner < 8; ++corner) {
                    const std::uint8_t rank =
                        of_vertices[x + corner % 2 +
                                    130 * (y + corner / 2 % 2 + 60 * (z + corner / 4))];
                    low = std::min(low, rank);
                    high = std::max(high, rank);
                }
                ASSERT_EQ(ranks.at(step).low[cell], low);
                ASSERT_EQ(ranks.at(step).high[cell], high);
            }
        }
    }
}

TEST(CellUnit, HasTheSameBytesEveryTime) {
    const TestField field({45, 40, 41}, 12, ValueType::u8, moving_sphere);
    const LevelMap levels = LevelMap::of_type(ValueType::u8);
    const CellSeries series(field.view(), levels), again(field.view(), levels);
    EXPECT_EQ(series.cells, again.cells);
    EXPECT_EQ(series.deltas, again.deltas);
    // Nor does it matter what was built before with the same work space.
    StretchRanks ranks(field.view(), levels);
    CellUnitBuilder builder;
    std::vector<std::byte> bytes(100, std::byte{1});
    for (std::uint32_t stretch = Stretches(field.view().grid).count(); stretch-- > 0;) {
        ranks.compute(stretch, 0, 12);
        builder.build_deltas(ranks, 0, bytes);
        EXPECT_EQ(bytes, series.deltas[stretch]);
        builder.build_cells(ranks, 0, true, bytes);
        EXPECT_EQ(bytes, series.cells[stretch]);
    }
}

TEST(CellUnit, HasTheSameBytesOnEveryTarget) {
    std::mt19937 random(test_seed());
    // The last word of cells is a part of one.
    const TestField field({45, 40, 41}, 5, ValueType::u8, scaled(turbulence(random), 250, 127));
    std::vector<std::uint64_t> thresholds(200);
    std::iota(thresholds.begin(), thresholds.end(), 20);
    for (const LevelMap& levels :
         {LevelMap::of_type(ValueType::u8), LevelMap::of_thresholds(ValueType::u8, thresholds)}) {
        const CellSeries series(field.view(), levels);
        for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
            hwy::SetSupportedTargetsForTest(target);
            const CellSeries again(field.view(), levels);
            EXPECT_EQ(series.cells, again.cells) << hwy::TargetName(target);
            EXPECT_EQ(series.deltas, again.deltas) << hwy::TargetName(target);
        }
        hwy::SetSupportedTargetsForTest(0);
    }
}

TEST(CellUnit, TakesFewBytesForACoherentSeries) {
    const TestField field({61, 50, 60}, 25, ValueType::u8, moving_sphere);
    const CellSeries series(field.view(), LevelMap::of_type(ValueType::u8));
    const double raw = 25.0 * static_cast<double>(field.view().grid.cell_count()) * 24;
    EXPECT_LT(100 * static_cast<double>(series.cell_bytes()) / raw, 7);
    EXPECT_LT(100 * static_cast<double>(series.cell_bytes() + series.delta_bytes()) / raw, 14);
}

} // namespace
} // namespace isochron::index
