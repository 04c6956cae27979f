// Cells of one chunk sorted in span space: any isovalue's are found as a few contiguous runs.
#pragma once

#include "index/cells/cell_table_head.h"
#include "index/cells/id_runs.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// Every entry is a cell with a column and a row of span space, column <= row < 256: it counts at
/// the levels from its column to its row. Entries are sorted by row, within it by column, within
/// an element by id. The columns of even rows descend and those of odd rows ascend, so that what
/// counts at a level is at the end of the one and at the beginning of the next: one run for each
/// *pair* of rows. Its *anchor* is where the odd row begins.
///
/// The directory of a large table has a *line* for each column c: for each pair of rows from c on,
/// how many entries of either row have a column <= c, up to the last row that has any. A query
/// reads one line. Lengths take a byte each: a line counts from the last multiple of 2^form columns
/// on, and a *base line* has what lies before that, in 16 bits. Where a byte is too little even so,
/// the line is *wide*: 16 bits for each length, without a base.
/// A small table lists its elements instead.
///
/// Only `check` trusts nothing: all else is for tables that passed it.
class CellTable {
  public:
    /// @param head of a table, with kSlack ids behind the table's last
    explicit CellTable(const std::byte* head) : bytes_(head) {}

    /// Whether the table lies within so many bytes, and whether a search stays inside; does not
    /// read the ids.
    static bool check(std::span<const std::byte> bytes);
    /// Whether all ids are those of a chunk's cells; reads them all.
    bool has_ids_below(std::uint32_t cells) const;

    /// Bytes of the whole table.
    std::size_t size() const;
    const CellTableHead& head() const { return *reinterpret_cast<const CellTableHead*>(bytes_); }

    /// Appends the entries of columns up to `column`. @param rows not below the column
    void up_to(std::uint32_t column, SpanRows rows, CellId first, RunBuffer& out) const;
    /// Appends the entries of the columns above `below`, which may be -1, up to `column`.
    /// @param rows not below the column
    void between(std::int32_t below, std::uint32_t column, SpanRows rows, CellId first,
                 RunBuffer& out) const;

  private:
    template <class F>
    decltype(auto) visit(F&& f) const;

    const std::byte* bytes_;
};

} // namespace isochron::index
