// Cells of one chunk sorted in span space: any isovalue's are found as a few contiguous runs.
#pragma once

#include "index/id_runs.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// Begins a table; the directory and the ids follow it. Everything is little-endian.
struct CellTableHead {
    static constexpr std::uint8_t kSparse = 0; ///< the directory lists elements

    std::uint32_t entries;
    std::uint16_t size;      ///< elements, or half-words of all lines
    std::uint16_t base_size; ///< pairs of lengths in all base lines
    std::uint8_t first_column, first_row, last_row;
    /// From 1 to 8: the directory has lines, and a base line for every 2^form columns.
    std::uint8_t form;
    /// Where the parts begin that a search reads, in bytes from here; see CellTableLayout.
    std::uint16_t starts, wide, base_starts, bases;
    std::uint32_t lengths, ids;

    bool operator==(const CellTableHead&) const = default;
};
static_assert(sizeof(CellTableHead) == 28);

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
    static constexpr std::uint32_t kRows = 256;
    static constexpr std::uint32_t kMaxElements = 256; ///< of a sparse directory
    static constexpr std::size_t kAlignment = 4;

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

    /// Rows `begin` to `end - 1` of span space.
    struct Rows {
        std::uint32_t begin, end = kRows;
    };
    /// Appends the entries of columns up to `column`. @param rows not below the column
    void up_to(std::uint32_t column, Rows rows, CellId first, RunBuffer& out) const;
    /// Appends the entries of the columns above `below`, which may be -1, up to `column`.
    /// @param rows not below the column
    void between(std::int32_t below, std::uint32_t column, Rows rows, CellId first,
                 RunBuffer& out) const;

  private:
    template <class F>
    decltype(auto) visit(F&& f) const;

    const std::byte* bytes_;
};

} // namespace isochron::index
