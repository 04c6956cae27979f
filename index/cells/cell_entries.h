// Selects the cells that become entries of a table, a SIMD vector at a time; compiled once for each
// SIMD target.
#pragma once

#include "index/cells/stretch_ranks.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// The entries of one table before they are sorted. There are two lists, so that a processor can
/// overlap the counting of both. Within an element, entries of the first list come first.
struct CellEntries {
    struct List {
        std::vector<std::uint16_t> keys; ///< row * 256 + column
        std::vector<std::uint16_t> ids;  ///< ascending
        std::uint32_t count = 0;
    };
    /// The part of span space that the entries take up.
    struct Bounds {
        std::uint8_t first_column = 0xff, first_row = 0xff, last_row = 0;
        std::uint8_t span = 0; ///< largest difference of an entry's row and column
    };

    CellEntries();
    std::uint32_t count() const { return lists[0].count + lists[1].count; }

    std::array<List, 2> lists;
    Bounds bounds;
};

/// A set of cells as bits, 64 in a word from the lowest bit on; bits after the last cell are 0.
using CellBits = std::vector<std::uint64_t>;

/// Two neighboring time spans have sets of cells that are constant over them. Finds the cells that
/// are in both sets and constant over both spans together, and moves them from both sets to
/// `joined`.
/// @param a, b extremes at any step of the two spans @return number of joined cells that are active
///        at any isovalue
std::size_t join_spans(const StretchRanks::Extremes& a, const StretchRanks::Extremes& b,
                       CellBits& left, CellBits& right, CellBits& joined);

/// Sets the bits of the cells whose extremes differ.
void find_changes(const StretchRanks::Extremes& a, const StretchRanks::Extremes& b,
                  CellBits& changed);

/// Makes entries of the chosen cells that are active at any isovalue, with levels as in CellUnit
/// (cell_unit.h).
void select_cells(const StretchRanks::Extremes& extremes, const CellBits& chosen, bool lossless,
                  CellEntries& out);

/// Makes entries of the levels that the intervals of the chosen cells have in `to` but not in
/// `from`: one list for the parts below the interval in `from`, one for the parts above it. The
/// ranks are of a lossless map.
void select_differences(const StretchRanks::Extremes& from, const StretchRanks::Extremes& to,
                        const CellBits& chosen, CellEntries& out);

} // namespace isochron::index
