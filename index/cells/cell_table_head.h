// The first bytes of a cell table.
#pragma once

#include <cstddef>
#include <cstdint>

namespace isochron::index {

/// Begins a table; the directory and the ids follow it. Everything is little-endian.
struct CellTableHead {
    static constexpr std::uint8_t kSparse = 0;         ///< the directory lists elements
    static constexpr std::uint32_t kRows = 256;        ///< rows, and columns, of span space
    static constexpr std::uint32_t kMaxElements = 256; ///< most elements of a sparse directory
    static constexpr std::size_t kAlignment = 4;       ///< [bytes] of every table

    std::uint32_t entries;
    std::uint16_t size;      ///< elements, or half-words of all lines
    std::uint16_t base_size; ///< pairs of lengths in all base lines
    std::uint8_t first_column, first_row, last_row;
    /// kSparse, or 1 to 8: the directory has lines, and a base line for every 2^form columns.
    std::uint8_t form;
    /// Byte offsets, from the head, of the parts that a search reads; see CellTableLayout.
    std::uint16_t starts, wide, base_starts, bases;
    std::uint32_t lengths, ids;

    bool operator==(const CellTableHead&) const = default;
};
static_assert(sizeof(CellTableHead) == 28);

/// Rows `begin` to `end - 1` of span space.
struct SpanRows {
    std::uint32_t begin, end = CellTableHead::kRows;
};

} // namespace isochron::index
