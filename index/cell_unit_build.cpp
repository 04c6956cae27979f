// Building of cells and deltas: where in the time tree a cell is constant, and what changes.
#include "index/cell_unit_build.h"

#include "index/cell_unit.h"
#include "index/time_tree.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

namespace isochron::index {
namespace {

using Extremes = ChunkRanks::Extremes;

/// The head and the references of a unit that is being built.
class UnitBytes {
  public:
    UnitBytes(std::uint32_t magic, std::uint32_t tables, std::uint32_t steps, std::uint32_t cells,
              bool lossless, std::vector<std::byte>& out)
        : head_{magic, tables, steps, cells, lossless, 0, 0}, refs_(tables), out_(out) {
        out_.clear();
        out_.resize(sizeof head_ + tables * sizeof(TableRef));
    }

    void append(std::uint32_t table, CellTableBuilder& entries) {
        if (entries.entries() == 0)
            return;
        const std::size_t offset = out_.size();
        entries.append_to(out_);
        CellTableHead head;
        std::memcpy(&head, out_.data() + offset, sizeof head);
        refs_[table] = {static_cast<std::uint32_t>(offset / CellTable::kAlignment),
                        head.first_column, head.last_row};
    }

    void finish() {
        out_.resize((out_.size() + IdRun::kSlack * sizeof(std::uint16_t) + 7) / 8 * 8);
        head_.bytes = out_.size();
        std::memcpy(out_.data(), &head_, sizeof head_);
        std::memcpy(out_.data() + sizeof head_, refs_.data(), refs_.size() * sizeof(TableRef));
    }

  private:
    CellUnitHead head_;
    std::vector<TableRef> refs_;
    std::vector<std::byte>& out_;
};

/// Calls `f` with the places of the flags that are not 0. @param flags 0 or 1, 8 more than `count`
template <class F>
void for_each_set(const std::uint8_t* flags, std::uint32_t count, F&& f) {
    for (std::uint32_t i = 0; i < count; i += 8) {
        std::uint64_t eight;
        std::memcpy(&eight, flags + i, 8);
        if (i + 8 > count)
            eight &= (std::uint64_t{1} << 8 * (count - i)) - 1;
        for (; eight; eight &= eight - 1)
            f(i + static_cast<std::uint32_t>(std::countr_zero(eight)) / 8);
    }
}

} // namespace

/// The cells of one unit, from the leaves of the time tree up.
struct CellUnitBuilder::Cells {
    const ChunkRanks& ranks;
    std::uint32_t first; ///< step among those of the ranks
    bool lossless;
    CellTableBuilder& table;
    UnitBytes& unit;
    std::uint8_t* flags; ///< two rows of `stride` for each depth
    std::size_t stride;

    std::uint8_t* row(std::uint32_t depth, int side) {
        return flags + (2 * std::size_t{depth} + side) * stride;
    }

    /// Sets a flag in `constant` for every cell that is constant over the node's span, after
    /// building the nodes below.
    void visit(const TimeNode& node, std::uint8_t* constant) {
        if (node.is_leaf()) {
            std::fill_n(constant, ranks.cells(), std::uint8_t{1});
            return;
        }
        const TimeNode left = node.left(), right = node.right();
        std::uint8_t *left_flags = row(node.depth, 0), *right_flags = row(node.depth, 1);
        visit(left, left_flags);
        visit(right, right_flags);
        const Extremes a = ranks.at(first + left.first), b = ranks.at(first + right.first);
        for (std::uint32_t i = 0; i < ranks.cells(); ++i) {
            const bool same = (a.low[i] == b.low[i]) & (a.high[i] == b.high[i]);
            constant[i] = left_flags[i] & right_flags[i] & static_cast<std::uint8_t>(same);
            left_flags[i] &= static_cast<std::uint8_t>(~constant[i]);
            right_flags[i] &= static_cast<std::uint8_t>(~constant[i]);
        }
        store(left, left_flags);
        store(right, right_flags);
    }

    /// Makes the node's table of the cells whose flag is set, and clears the flags of the others
    /// that are never active.
    void store(const TimeNode& node, std::uint8_t* chosen) {
        const Extremes extremes = ranks.at(first + node.first);
        const std::uint8_t *low = extremes.low.data(), *high = extremes.high.data();
        for (std::uint32_t i = 0; i < ranks.cells(); ++i)
            chosen[i] &= static_cast<std::uint8_t>(lossless ? low[i] < high[i] : low[i] <= high[i]);
        for_each_set(chosen, ranks.cells(), [&](std::uint32_t i) {
            table.add(static_cast<std::uint16_t>(i), low[i],
                      static_cast<std::uint8_t>(high[i] - lossless));
        });
        unit.append(node.number, table);
    }
};

void CellUnitBuilder::build_cells(const ChunkRanks& ranks, std::uint32_t first, bool lossless,
                                  std::vector<std::byte>& out) {
    assert(first < ranks.steps());
    const std::uint32_t steps = ranks.steps() - first;
    UnitBytes unit(CellUnit::kMagic, TimeNode::count(steps), steps, ranks.cells(), lossless, out);
    const std::size_t stride = ranks.cells() + 8;
    const std::size_t depths = 2 + std::bit_width(steps);
    flags_.resize(2 * depths * stride);
    Cells cells{ranks, first, lossless, table_, unit, flags_.data(), stride};
    const TimeNode root = TimeNode::root(steps);
    std::uint8_t* constant = cells.row(static_cast<std::uint32_t>(depths - 1), 0);
    cells.visit(root, constant);
    cells.store(root, constant);
    unit.finish();
}

void CellUnitBuilder::build_deltas(const ChunkRanks& ranks, std::uint32_t first,
                                   std::vector<std::byte>& out) {
    assert(first <= 1 && first < ranks.steps());
    const std::uint32_t steps = ranks.steps() - first;
    UnitBytes unit(DeltaUnit::kMagic, 2 * steps, steps, ranks.cells(), true, out);
    flags_.resize(ranks.cells() + 8);
    for (std::uint32_t into = first == 0 ? 1 : 0; into < steps; ++into) {
        const Extremes before = ranks.at(first + into - 1), after = ranks.at(first + into);
        for (std::uint32_t i = 0; i < ranks.cells(); ++i)
            flags_[i] = (before.low[i] != after.low[i]) | (before.high[i] != after.high[i]);
        add_difference(before, after);
        unit.append(2 * into, table_);
        add_difference(after, before);
        unit.append(2 * into + 1, table_);
    }
    unit.finish();
}

/// Adds what `to` has more than `from`, of the cells that differ: at most one interval below and
/// one above.
void CellUnitBuilder::add_difference(const Extremes& from, const Extremes& to) {
    for_each_set(flags_.data(), static_cast<std::uint32_t>(to.low.size()), [&](std::uint32_t i) {
        const std::uint8_t low = to.low[i], high = to.high[i];
        if (low >= high)
            return;
        // Nothing to subtract is an interval that begins where the other one ends.
        const bool empty = from.low[i] >= from.high[i];
        const std::uint8_t from_low = empty ? high : from.low[i];
        const std::uint8_t from_high = empty ? high : from.high[i];
        const auto id = static_cast<std::uint16_t>(i);
        if (low < from_low)
            table_.add(id, low, static_cast<std::uint8_t>(std::min(high, from_low) - 1));
        if (high > from_high)
            table_.add(id, std::max(low, from_high), static_cast<std::uint8_t>(high - 1));
    });
}

} // namespace isochron::index
