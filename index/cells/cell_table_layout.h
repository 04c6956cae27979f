// The byte offsets of the parts of a cell table, for its search and its builder.
#pragma once

#include "index/cells/cell_table_head.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace isochron::index {

/// Offsets in bytes from the table's head.
struct CellTableLayout {
    // sparse: for every element, in the order of the ids
    std::size_t columns = 0, rows = 0; ///< u8
    std::size_t begins = 0;            ///< u16 for each element and one more: its first entry
    // with lines
    std::size_t anchors = 0;     ///< u16 or u32, of every pair of rows from `first_pair` on
    std::size_t starts = 0;      ///< u16 for each line and one more: its offset, in units of u16
    std::size_t wide = 0;        ///< a bit for each line
    std::size_t base_starts = 0; ///< u16 for each base line and one more: its offset, in pairs
    std::size_t bases = 0;       ///< u16, even row before odd row
    std::size_t lengths = 0;     ///< u8, u16 in wide lines; even row before odd row
    // all
    std::size_t ids = 0; ///< u16
    std::size_t end = 0;

    static std::uint32_t first_pair(const CellTableHead& head) { return head.first_row / 2u; }
    static std::uint32_t pairs(const CellTableHead& head) {
        return head.last_row / 2u + 1 - first_pair(head);
    }
    /// Whether entries are few enough for an anchor to fit 16 bits.
    static bool short_anchors(const CellTableHead& head) { return head.entries <= 0xffff; }
    /// One line for each column from `first_column` to `last_row`.
    static std::uint32_t lines(const CellTableHead& head) {
        return head.last_row + 1u - head.first_column;
    }
    /// The base line of a column has the number column >> form.
    static std::uint32_t first_base(const CellTableHead& head) {
        return head.first_column >> head.form;
    }
    static std::uint32_t base_lines(const CellTableHead& head) {
        return (head.last_row >> head.form) + 1 - first_base(head);
    }
    /// The first pair of rows that a column's line covers.
    static std::uint32_t first_pair(const CellTableHead& head, std::uint32_t column) {
        return std::max(first_pair(head), column / 2);
    }

    /// @param head with first_row <= last_row and first_column <= last_row
    explicit CellTableLayout(const CellTableHead& head) {
        std::size_t at = sizeof head;
        const auto part = [&](std::size_t& offset, std::size_t bytes) {
            offset = at;
            at += bytes;
        };
        const std::size_t size = head.size;
        if (head.form == CellTableHead::kSparse) {
            part(columns, size);
            part(rows, size);
            part(begins, (size + 1) * sizeof(std::uint16_t));
        } else {
            part(anchors, pairs(head) * (short_anchors(head) ? 2 : 4));
            part(starts, (lines(head) + 1) * sizeof(std::uint16_t));
            part(wide, (lines(head) + 15) / 16 * sizeof(std::uint16_t));
            part(base_starts, (base_lines(head) + 1) * sizeof(std::uint16_t));
            part(bases, 2 * head.base_size * sizeof(std::uint16_t));
            part(lengths, size * sizeof(std::uint16_t));
        }
        part(ids, head.entries * sizeof(std::uint16_t));
        end = (at + CellTableHead::kAlignment - 1) / CellTableHead::kAlignment *
              CellTableHead::kAlignment;
    }
};

/// The head with the offsets that follow from its other numbers.
inline CellTableHead with_offsets(CellTableHead head) {
    const CellTableLayout layout(head);
    head.starts = static_cast<std::uint16_t>(layout.starts);
    head.wide = static_cast<std::uint16_t>(layout.wide);
    head.base_starts = static_cast<std::uint16_t>(layout.base_starts);
    head.bases = static_cast<std::uint16_t>(layout.bases);
    head.lengths = static_cast<std::uint32_t>(layout.lengths);
    head.ids = static_cast<std::uint32_t>(layout.ids);
    return head;
}

} // namespace isochron::index
