// Builds cells, by the time nodes over which a cell is constant, and deltas, by what changes.
#include "index/cells/cell_unit_build.h"

#include "index/cells/cell_unit.h"
#include "index/volume/time_tree.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

namespace isochron::index {
namespace {

using Extremes = StretchRanks::Extremes;

/// Fewest cells that get their own table. The directory of a smaller table takes about as many
/// bytes as storing its cells twice, and every search in its span must go through it.
constexpr std::size_t kFewest = 512;

} // namespace

/// The head and the references of a unit that is being built.
class UnitUnderWay {
  public:
    UnitUnderWay(std::uint32_t magic, std::uint32_t tables, std::uint32_t steps,
                 std::uint32_t cells, bool lossless, std::vector<std::byte>& out)
        : head_{magic, tables, steps, cells, lossless, 0, 0}, refs_(tables), out_(out) {
        out_.clear();
        out_.resize(sizeof head_ + tables * sizeof(TableRef));
    }

    void append(std::uint32_t table, CellTableBuilder& builder) {
        if (builder.entries().count() == 0)
            return;
        const std::size_t offset = out_.size();
        const CellTableHead head = builder.append_to(out_);
        const auto bytes = std::span<const std::byte>(out_).subspan(offset);
        refs_[table] = {static_cast<std::uint32_t>(offset / CellTableHead::kAlignment),
                        static_cast<std::uint32_t>(bytes.size() / CellTableHead::kAlignment),
                        cell_checksum(bytes.first(head.ids)), head.first_column, head.last_row};
    }

    void finish() {
        out_.resize((out_.size() + IdRun::kSlack * sizeof(std::uint16_t) + 7) / 8 * 8);
        head_.bytes = out_.size();
        const std::size_t refs_bytes = refs_.size() * sizeof(TableRef);
        std::memcpy(out_.data(), &head_, sizeof head_);
        std::memcpy(out_.data() + sizeof head_, refs_.data(), refs_bytes);
        head_.checksum = cell_checksum(std::span(out_).first(sizeof head_ + refs_bytes));
        std::memcpy(out_.data(), &head_, sizeof head_);
    }

  private:
    CellUnitHead head_;
    std::vector<TableRef> refs_;
    std::vector<std::byte>& out_;
};

/// The cells of one unit, from the leaves of the time tree up.
struct CellUnitBuilder::Cells {
    const StretchRanks& ranks;
    std::uint32_t first; ///< number of the first step in the ranks
    bool lossless;
    CellTableBuilder& table;
    UnitUnderWay& unit;
    std::vector<std::array<CellBits, 2>>& bits; ///< bits of the children, by depth

    /// Builds the nodes below, then sets the bits of the cells that are constant over the node's
    /// span.
    void visit(const TimeNode& node, CellBits& constant) {
        if (node.is_leaf()) {
            std::fill(constant.begin(), constant.end(), ~std::uint64_t{0});
            if (const std::uint32_t past = ranks.cells() % 64)
                constant.back() = (std::uint64_t{1} << past) - 1;
            return;
        }
        const TimeNode left = node.left(), right = node.right();
        auto& [left_bits, right_bits] = bits[node.depth];
        visit(left, left_bits);
        visit(right, right_bits);
        const std::size_t joined =
            join_spans(ranks.at(first + left.first), ranks.at(first + right.first), left_bits,
                       right_bits, constant);
        if (joined < kFewest)
            part(left_bits, right_bits, constant);
        store(left, left_bits);
        store(right, right_bits);
    }

    static void part(CellBits& left, CellBits& right, CellBits& joined) {
        for (std::size_t word = 0; word < joined.size(); ++word) {
            left[word] |= joined[word];
            right[word] |= joined[word];
            joined[word] = 0;
        }
    }

    void store(const TimeNode& node, const CellBits& chosen) {
        select_cells(ranks.at(first + node.first), chosen, lossless, table.entries());
        unit.append(node.number, table);
    }
};

void CellUnitBuilder::build_cells(const StretchRanks& ranks, std::uint32_t first, bool lossless,
                                  std::vector<std::byte>& out) {
    assert(first < ranks.steps());
    const std::uint32_t steps = ranks.steps() - first;
    UnitUnderWay unit(CellUnit::kMagic, TimeNode::count(steps), steps, ranks.cells(), lossless,
                      out);
    const std::size_t words = (ranks.cells() + 63) / 64;
    bits_.resize(std::bit_width(steps) + 1);
    for (auto& of_depth : bits_)
        for (CellBits& of_child : of_depth)
            of_child.resize(words);
    Cells cells{ranks, first, lossless, table_, unit, bits_};
    const TimeNode root = TimeNode::root(steps);
    CellBits& constant = bits_.back()[0];
    cells.visit(root, constant);
    cells.store(root, constant);
    unit.finish();
}

void CellUnitBuilder::build_deltas(const StretchRanks& ranks, std::uint32_t first,
                                   std::vector<std::byte>& out) {
    assert(first <= 1 && first < ranks.steps());
    const std::uint32_t steps = ranks.steps() - first;
    UnitUnderWay unit(DeltaUnit::kMagic, 2 * steps, steps, ranks.cells(), true, out);
    CellBits changed((ranks.cells() + 63) / 64);
    for (std::uint32_t into = first == 0 ? 1 : 0; into < steps; ++into) {
        const Extremes before = ranks.at(first + into - 1), after = ranks.at(first + into);
        find_changes(before, after, changed);
        select_differences(before, after, changed, table_.entries());
        unit.append(2 * into, table_);
        select_differences(after, before, changed, table_.entries());
        unit.append(2 * into + 1, table_);
    }
    unit.finish();
}

} // namespace isochron::index
