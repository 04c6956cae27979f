// Counting sort of a cell table's entries, and its directory.
#include "index/cell_table_builder.h"

#include "index/cell_table_layout.h"
#include "index/chunking.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <numeric>
#include <utility>

namespace isochron::index {

namespace {

std::uint32_t key(std::uint32_t row, std::uint32_t column) {
    return row << 8 | column;
}

/// Calls `f(list, i)` for all entries of two lists, in turns.
template <class F>
void in_turns(const std::array<CellEntries::List, 2>& lists, F&& f) {
    const std::uint32_t both = std::min(lists[0].count, lists[1].count);
    for (std::uint32_t i = 0; i < both; ++i) {
        f(0, i);
        f(1, i);
    }
    for (std::size_t list : {0, 1})
        for (std::uint32_t i = both; i < lists[list].count; ++i)
            f(list, i);
}

} // namespace

/// What part of span space the entries take up.
struct CellTableBuilder::Band {
    CellTableHead head{};
    std::uint32_t span = 0; ///< most that a row exceeds its column
    std::array<std::uint32_t, CellTable::kRows> row_count{}, row_begin{}; ///< entries
    /// One behind the last row that has an entry of this column or one below.
    std::array<std::uint32_t, CellTable::kRows> rows_end{};

    std::uint32_t first_column(std::uint32_t row) const { return row - std::min(row, span); }
    /// Pairs of rows that the line of a column covers.
    std::uint32_t line_pairs(std::uint32_t column) const {
        const std::uint32_t first = CellTableLayout::first_pair(head, column);
        return std::max(first, (rows_end[column] + 1) / 2) - first;
    }
};

CellTableBuilder::CellTableBuilder() {
    for (auto& counts : counts_)
        counts.resize(std::size_t{CellTable::kRows} * CellTable::kRows);
}

/// Counts the entries of each element and chooses the directory.
CellTableBuilder::Band CellTableBuilder::count() {
    const std::array keys{entries_.lists[0].keys.data(), entries_.lists[1].keys.data()};
    const std::array counts{counts_[0].data(), counts_[1].data()};
    in_turns(entries_.lists,
             [&](std::size_t list, std::uint32_t i) { ++counts[list][keys[list][i]]; });

    Band band;
    const auto& [first_column, first_row, last_row, span] = entries_.bounds;
    band.span = span;
    band.head.entries = entries_.count();
    band.head.first_column = first_column;
    band.head.first_row = first_row;
    band.head.last_row = last_row;
    std::uint32_t elements = 0;
    for (std::uint32_t row = first_row; row <= last_row; ++row)
        for (std::uint32_t column = band.first_column(row); column <= row; ++column) {
            const std::uint32_t k = key(row, column);
            const std::uint32_t count = std::uint32_t{counts[0][k]} + counts[1][k];
            if (count) {
                band.row_count[row] += count;
                band.rows_end[column] = row + 1;
                ++elements;
            }
        }
    std::exclusive_scan(band.row_count.begin(), band.row_count.end(), band.row_begin.begin(), 0u);
    std::uint32_t pairs = 0;
    for (std::uint32_t column = first_column, end = 0; column <= last_row; ++column) {
        band.rows_end[column] = end = std::max(end, band.rows_end[column]);
        pairs += band.line_pairs(column);
    }
    const bool fits = *std::max_element(band.row_count.begin(), band.row_count.end()) <= 0xff;
    band.head.form = fits ? CellTableHead::narrow : CellTableHead::wide;
    band.head.size = pairs;
    CellTableHead sparse = band.head;
    sparse.form = CellTableHead::sparse;
    sparse.size = elements;
    if (elements <= CellTable::kMaxElements && band.head.entries <= 0xffff &&
        CellTableLayout(sparse).end <= CellTableLayout(band.head).end)
        band.head = sparse;
    return band;
}

/// Writes everything, to bytes that are 0.
void CellTableBuilder::write(const Band& band, std::byte* table) {
    std::memcpy(table, &band.head, sizeof band.head);
    const CellTableLayout layout(band.head);
    switch (band.head.form) {
    case CellTableHead::sparse: write_elements(band, layout, table); break;
    case CellTableHead::narrow: write_lines<std::uint8_t>(band, layout, table); break;
    case CellTableHead::wide: write_lines<std::uint16_t>(band, layout, table); break;
    }
    auto* ids = reinterpret_cast<std::uint16_t*>(table + layout.ids);
    const std::array keys{entries_.lists[0].keys.data(), entries_.lists[1].keys.data()};
    const std::array sources{entries_.lists[0].ids.data(), entries_.lists[1].ids.data()};
    const std::array places{counts_[0].data(), counts_[1].data()};
    in_turns(entries_.lists, [&](std::size_t list, std::uint32_t i) {
        const std::uint16_t k = keys[list][i];
        ids[band.row_begin[k >> 8] + places[list][k]++] = sources[list][i];
    });
    for (auto& counts : counts_)
        for (std::uint32_t row = band.head.first_row; row <= band.head.last_row; ++row)
            std::fill(&counts[key(row, band.first_column(row))], &counts[key(row, row)] + 1, 0);
}

/// Turns the counts of a row into the places of its elements' first entries within the row.
template <class F>
void CellTableBuilder::place_row(const Band& band, std::uint32_t row, F&& placed) {
    if (band.row_count[row] == 0)
        return;
    const std::uint32_t first = band.first_column(row);
    std::uint32_t at = 0;
    for (std::uint32_t i = 0; i <= row - first; ++i) {
        const std::uint32_t column = row % 2 == 0 ? row - i : first + i;
        const std::uint32_t k = key(row, column), begin = at;
        for (auto& counts : counts_)
            at += std::exchange(counts[k], static_cast<std::uint16_t>(at));
        if (at != begin)
            placed(column, begin);
    }
}

void CellTableBuilder::write_elements(const Band& band, const CellTableLayout& layout,
                                      std::byte* table) {
    auto* columns = reinterpret_cast<std::uint8_t*>(table + layout.columns);
    auto* rows = reinterpret_cast<std::uint8_t*>(table + layout.rows);
    auto* begins = reinterpret_cast<std::uint16_t*>(table + layout.begins);
    for (std::uint32_t row = band.head.first_row; row <= band.head.last_row; ++row)
        place_row(band, row, [&](std::uint32_t column, std::uint32_t begin) {
            *columns++ = static_cast<std::uint8_t>(column);
            *rows++ = static_cast<std::uint8_t>(row);
            *begins++ = static_cast<std::uint16_t>(band.row_begin[row] + begin);
        });
    *begins = static_cast<std::uint16_t>(band.head.entries);
}

template <class Length>
void CellTableBuilder::write_lines(const Band& band, const CellTableLayout& layout,
                                   std::byte* table) {
    const CellTableHead& head = band.head;
    auto* anchors = reinterpret_cast<std::uint32_t*>(table + layout.anchors);
    auto* starts = reinterpret_cast<std::uint16_t*>(table + layout.starts);
    auto* lengths = reinterpret_cast<Length*>(table + layout.lengths);
    for (std::uint32_t column = head.first_column; column <= head.last_row; ++column)
        starts[column + 1 - head.first_column] = static_cast<std::uint16_t>(
            starts[column - head.first_column] + band.line_pairs(column));
    // A line covers every pair in which it has a length that is not 0.
    const auto set = [&](std::uint32_t row, std::uint32_t column, std::uint32_t length) {
        if (length == 0)
            return;
        const std::uint32_t pair = starts[column - head.first_column] + row / 2 -
                                   CellTableLayout::first_pair(head, column);
        lengths[2 * pair + row % 2] = static_cast<Length>(length);
    };
    for (std::uint32_t even = head.first_row & ~1u; even <= head.last_row; even += 2)
        *anchors++ = band.row_begin[even] + band.row_count[even];
    for (std::uint32_t row = head.first_row; row <= head.last_row; ++row) {
        if (band.row_count[row] == 0)
            continue;
        place_row(band, row, [](auto...) {});
        // In either order the last column's length is the whole row's.
        const std::uint32_t first = band.first_column(row);
        if (row % 2 == 0)
            for (std::uint32_t column = first; column < row; ++column)
                set(row, column, band.row_count[row] - counts_[0][key(row, column)]);
        else
            for (std::uint32_t column = first; column < row; ++column)
                set(row, column, counts_[0][key(row, column + 1)]);
        set(row, row, band.row_count[row]);
        // A length is nowhere below that of the line before.
        if (row % 2 == 0 && row < head.last_row)
            set(row, row + 1, band.row_count[row]);
    }
}

CellTableHead CellTableBuilder::append_to(std::vector<std::byte>& bytes) {
    assert(entries_.count() > 0 && bytes.size() % CellTable::kAlignment == 0);
    const Band band = count();
    const std::size_t begin = bytes.size();
    bytes.resize(begin + CellTableLayout(band.head).end);
    write(band, bytes.data() + begin);
    for (CellEntries::List& list : entries_.lists)
        list.count = 0;
    entries_.bounds = {};
    return band.head;
}

} // namespace isochron::index
