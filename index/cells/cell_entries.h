// Which cells become entries of a table, a vector at a time; compiled once for each SIMD target.
#pragma once

#include "index/cells/chunk_ranks.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// The entries of one table before they are sorted: two lists, so that counting them makes two
/// chains of work for a processor to overlap. Within an element those of the first come first.
struct CellEntries {
    struct List {
        std::vector<std::uint16_t> keys; ///< row * 256 + column
        std::vector<std::uint16_t> ids;  ///< ascending
        std::uint32_t count = 0;
    };
    /// What part of span space they take up.
    struct Bounds {
        std::uint8_t first_column = 0xff, first_row = 0xff, last_row = 0;
        std::uint8_t span = 0; ///< most that a row exceeds its column
    };

    CellEntries();
    std::uint32_t count() const { return lists[0].count + lists[1].count; }

    std::array<List, 2> lists;
    Bounds bounds;
};

/// Cells as bits, 64 to a word from the lowest bit on; those past the last cell are 0.
using CellBits = std::vector<std::uint64_t>;

/// Finds the cells of which two neighboring spans of time, each constant in the chosen cells, make
/// one constant span, and takes them out of both.
/// @param a, b extremes at any step of the two spans @return how many of the
///   cells are active at any isovalue at all
std::size_t join_spans(const ChunkRanks::Extremes& a, const ChunkRanks::Extremes& b, CellBits& left,
                       CellBits& right, CellBits& joined);

/// Sets the bits of the cells whose extremes differ.
void find_changes(const ChunkRanks::Extremes& a, const ChunkRanks::Extremes& b, CellBits& changed);

/// Makes entries of the chosen cells that are active at any isovalue at all: their levels are
/// those of CellUnit (cell_unit.h).
void select_cells(const ChunkRanks::Extremes& extremes, const CellBits& chosen, bool lossless,
                  CellEntries& out);

/// Makes entries of what the intervals of the chosen cells have more in `to` than in `from`: one
/// list of the parts below, one of those above. The ranks are those of a lossless map.
void select_differences(const ChunkRanks::Extremes& from, const ChunkRanks::Extremes& to,
                        const CellBits& chosen, CellEntries& out);

} // namespace isochron::index
