// Cells of one stretch sorted in span space: the cells of any isovalue are a few contiguous runs.
#pragma once

#include "index/cells/cell_table_head.h"
#include "index/cells/id_runs.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// Every entry is a cell with a column and a row of span space, column <= row < 256: it counts at
/// the levels from its column to its row. Entries are sorted by row, within a row by column, within
/// an element by id. Columns descend in even rows and ascend in odd rows. So the entries that count
/// at a level are at the end of an even row and at the beginning of the next odd row: one run for
/// each *pair* of rows. The *anchor* of a pair is where its odd row begins.
///
/// The directory of a large table has a *line* for each column c. For each pair of rows from c on,
/// up to the last row with such entries, the line has two lengths: the numbers of entries with a
/// column <= c in the even and in the odd row. A query reads one line. A length takes one byte, as
/// it counts only the columns from the last multiple of 2^form on; a *base line* counts the columns
/// before that, with 16 bits. If a byte is not enough, the line is *wide*: 16 bits for each length,
/// and no base line. A small table lists its elements instead.
///
/// Only `check` accepts damaged tables; call the other functions for tables that passed it.
class CellTable {
  public:
    /// @param head of a table; IdRun::kSlack more ids must be readable after its last
    explicit CellTable(const std::byte* head) : bytes_(head) {}

    /// Whether the table lies within these bytes and a search in it stays inside; does not read the
    /// ids.
    static bool check(std::span<const std::byte> bytes);
    /// Whether all ids are below `cells`, the number of a stretch's cells; reads all ids.
    bool has_ids_below(std::uint32_t cells) const;

    /// Bytes of the whole table.
    std::size_t size() const;
    const CellTableHead& head() const { return *reinterpret_cast<const CellTableHead*>(bytes_); }

    /// Appends the entries of the columns up to `column`. @param rows not below `column`
    void up_to(std::uint32_t column, SpanRows rows, CellId first, RunBuffer& out) const;
    /// Appends the entries of the columns above `below`, which may be -1, up to `column`.
    /// @param rows not below `column`
    void between(std::int32_t below, std::uint32_t column, SpanRows rows, CellId first,
                 RunBuffer& out) const;

  private:
    template <class F>
    decltype(auto) visit(F&& f) const;

    const std::byte* bytes_;
};

} // namespace isochron::index
