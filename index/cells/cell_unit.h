// The cells of one stretch in one epoch, as tables by time node; its deltas, as tables by transition.
#pragma once

#include "index/cells/cell_table.h"
#include "index/volume/level_map.h"
#include "index/volume/time_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace isochron::index {

/// The first bytes of a unit. A TableRef for each table follows, then the tables, then
/// IdRun::kSlack ids.
struct CellUnitHead {
    std::uint32_t magic;
    std::uint32_t tables;
    std::uint32_t steps; ///< steps of the epoch
    std::uint32_t cells; ///< cells of the stretch
    std::uint32_t lossless;
    std::uint32_t checksum; ///< checksum of the rest of the head and the references
    std::uint64_t bytes;    ///< size of the unit, a multiple of 8
};
static_assert(sizeof(CellUnitHead) == 32);

/// The offset and size of a table, and the levels at which it has entries, so that a search can
/// skip most tables that have none.
struct TableRef {
    std::uint32_t offset = 0, size = 0; ///< in CellTableHead::kAlignment; offset 0: no entries
    /// Checksum of the table without its ids, which do not guide a search.
    std::uint32_t checksum = 0;
    std::uint8_t first_column = 0, last_row = 0;
    std::uint16_t reserved = 0;
};
static_assert(sizeof(TableRef) == 16);

/// The checksum of a table's bytes, or of a head and references with the head's checksum as 0.
std::uint32_t cell_checksum(std::span<const std::byte> bytes);

/// Tables in one block of bytes. A view: cheap to copy; the constructor does not read the bytes.
class CellTables {
  public:
    /// @param bytes aligned to 8
    explicit CellTables(std::span<const std::byte> bytes)
        : bytes_(bytes.data()), size_(bytes.size()) {}

    /// The numbers that the head must have.
    struct Expected {
        std::uint32_t magic, tables, steps, cells;
    };
    /// Whether the head and the references are intact. Call it before all other functions.
    bool check_head(const Expected& expected) const;
    /// Whether a table is intact, so that a search in it stays inside. Does not read its ids, which
    /// may be invalid.
    bool check_table(std::uint32_t table) const;
    /// Whether all tables are intact, with their ids.
    bool check_tables() const;

    /// The bytes of the head with that many references, as far as there are bytes.
    std::span<const std::byte> head_bytes(std::uint32_t tables) const {
        return {bytes_, std::min(size_, sizeof(CellUnitHead) + tables * sizeof(TableRef))};
    }
    /// The bytes of a table, if the head is intact; empty if it has no entries or lies outside.
    std::span<const std::byte> table_bytes(std::uint32_t table) const;

    /// Prefetches the reference of a table.
    void prefetch(std::uint32_t table) const { __builtin_prefetch(refs() + table); }
    /// Prefetches the beginning of a table, whose reference must be intact.
    void prefetch_table(std::uint32_t table) const {
        constexpr std::size_t kCacheLine = 64;
        const std::byte* begin =
            bytes_ + std::size_t{refs()[table].offset} * CellTableHead::kAlignment;
        __builtin_prefetch(begin);
        __builtin_prefetch(begin + kCacheLine);
    }

    const CellUnitHead& head() const { return *reinterpret_cast<const CellUnitHead*>(bytes_); }
    /// The table; none if it surely has no entries that count at the level.
    std::optional<CellTable> at_level(std::uint32_t table, std::uint32_t level) const {
        const TableRef& ref = refs()[table];
        if (ref.offset == 0 || level < ref.first_column || level > ref.last_row)
            return std::nullopt;
        return this->table(ref);
    }
    /// The table; none if it has no entries.
    std::optional<CellTable> at_any_level(std::uint32_t table) const {
        const TableRef& ref = refs()[table];
        return ref.offset ? std::optional(this->table(ref)) : std::nullopt;
    }
    /// Number of entries of every table, for reports.
    std::vector<std::uint32_t> entries() const;

  private:
    bool lies_inside(const TableRef& ref) const;
    const TableRef* refs() const {
        return reinterpret_cast<const TableRef*>(bytes_ + sizeof(CellUnitHead));
    }
    CellTable table(const TableRef& ref) const {
        return CellTable(bytes_ + std::size_t{ref.offset} * CellTableHead::kAlignment);
    }

    const std::byte* bytes_;
    std::size_t size_;
};

/// The time nodes that span a step, from the root or another such node down to the leaf.
class TimePath {
  public:
    /// Most steps of an epoch.
    static constexpr std::uint32_t kMaxSteps = 256;

    TimePath(TimeNode from, std::uint32_t step) {
        for (; !from.is_leaf(); from = from.towards(step))
            numbers_[count_++] = from.number;
        numbers_[count_++] = from.number;
    }
    /// The lowest node that spans two different steps.
    static TimeNode common(std::uint32_t steps, std::uint32_t step_a, std::uint32_t step_b) {
        TimeNode node = TimeNode::root(steps);
        while (node.towards(step_a).contains(step_b))
            node = node.towards(step_a);
        return node;
    }

    const std::uint32_t* begin() const { return numbers_.data(); }
    const std::uint32_t* end() const { return numbers_.data() + count_; }

  private:
    std::array<std::uint32_t, std::bit_width(kMaxSteps - 1) + 1> numbers_;
    std::size_t count_ = 0;
};

/// Number of epochs of a series: all but the last have TimePath::kMaxSteps steps.
constexpr std::uint32_t epoch_count(std::size_t steps) {
    return static_cast<std::uint32_t>((steps + TimePath::kMaxSteps - 1) / TimePath::kMaxSteps);
}

/// The cells of one stretch at the steps of one epoch, which are counted from 0 here. A cell is an
/// entry of the highest time nodes over whose span its extremes are constant. Nodes with only a few
/// of these cells have no entries; the cells are entries of the nodes below instead.
///
/// If the map is lossless, an entry's levels are the ranks from `low` to `high - 1`: level k is
/// between rank k and rank k + 1. If it is lossy, they are `low` to `high`: level k is rank k, at
/// which a cut may not tell the side of a vertex.
class CellUnit {
  public:
    static constexpr std::uint32_t kMagic = 0x4c4c4543; // "CELL"

    /// @param bytes aligned to 8, not read here @param first the stretch's first cell
    CellUnit(std::span<const std::byte> bytes, CellId first) : tables_(bytes), first_(first) {}

    /// Whether the head is intact and has these numbers of steps and cells.
    bool check_head(std::uint32_t steps, std::uint32_t cells) const;
    /// The bytes that `check_head` needs, and then the bytes of a time node's table.
    std::span<const std::byte> head_bytes(std::uint32_t steps) const {
        return tables_.head_bytes(TimeNode::count(steps));
    }
    std::span<const std::byte> table_bytes(std::uint32_t node) const {
        return tables_.table_bytes(node);
    }
    /// Whether a time node's table is intact, if the head is. Call it before a search in the table.
    bool check_table(std::uint32_t node) const { return tables_.check_table(node); }
    /// Whether everything is sound.
    bool check(std::uint32_t steps, std::uint32_t cells) const {
        return check_head(steps, cells) && tables_.check_tables();
    }

    void prefetch(const TimePath& path) const {
        for (const std::uint32_t node : path)
            tables_.prefetch(node);
    }
    /// Prefetches the tables, if the head and they are intact.
    void prefetch_tables(const TimePath& path) const {
        for (const std::uint32_t node : path)
            tables_.prefetch_table(node);
    }
    /// Appends the active cells in the time nodes on a path (in all nodes of a step if it begins at
    /// the root) to `certain`, and the cells that only the volume decides to `ambiguous`.
    void search(const TimePath& path, LevelMap::Cut cut, RunBuffer& certain,
                RunBuffer& ambiguous) const;
    /// Appends the cells that are active at only one of two isovalues. Both cuts must be exact.
    void level_difference(const TimePath& path, LevelMap::Cut from, LevelMap::Cut to,
                          RunBuffer& added, RunBuffer& removed) const;

    /// Number of entries of every time node, by its number (time_tree.h).
    std::vector<std::uint32_t> entries() const { return tables_.entries(); }

  private:
    CellTables tables_;
    CellId first_;
};

/// The changes in one stretch from each step to the next, as intervals of levels of a lossless map.
/// The first transition is from the step before the epoch into its first step; it is empty in the
/// first epoch.
class DeltaUnit {
  public:
    static constexpr std::uint32_t kMagic = 0x544c4544; // "DELT"

    /// @param bytes aligned to 8, not read here @param first the stretch's first cell
    DeltaUnit(std::span<const std::byte> bytes, CellId first) : tables_(bytes), first_(first) {}

    /// Whether the head is intact and has these numbers of steps and cells.
    bool check_head(std::uint32_t steps, std::uint32_t cells) const;
    /// The bytes that `check_head` needs, and then the bytes of a table: 2 * step for the cells
    /// that are added at a step, 2 * step + 1 for those that are removed.
    std::span<const std::byte> head_bytes(std::uint32_t steps) const {
        return tables_.head_bytes(2 * steps);
    }
    std::span<const std::byte> table_bytes(std::uint32_t table) const {
        return tables_.table_bytes(table);
    }
    /// Whether a transition's tables are intact, if the head is. Call it before a search in them.
    bool check_transition(std::uint32_t into_step) const {
        return tables_.check_table(2 * into_step) && tables_.check_table(2 * into_step + 1);
    }
    /// Whether everything is sound.
    bool check(std::uint32_t steps, std::uint32_t cells) const {
        return check_head(steps, cells) && tables_.check_tables();
    }

    void prefetch(std::uint32_t into_step) const { tables_.prefetch(2 * into_step); }
    /// Appends the cells that become active from the step before to this one, and the cells that
    /// cease to be active. For the opposite direction swap them. The cut must be exact.
    void change(std::uint32_t into_step, LevelMap::Cut cut, RunBuffer& added,
                RunBuffer& removed) const;

    /// Number of entries of every transition, added before removed.
    std::vector<std::uint32_t> entries() const { return tables_.entries(); }

  private:
    CellTables tables_;
    CellId first_;
};

} // namespace isochron::index
