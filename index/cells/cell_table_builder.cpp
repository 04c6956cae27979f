// Sorts a cell table's entries by counting, and writes its directory.
#include "index/cells/cell_table_builder.h"

#include "index/cells/cell_table_layout.h"
#include "index/volume/stretches.h"

#include <algorithm>
#include <bitset>
#include <cassert>
#include <cstring>
#include <numeric>
#include <utility>

namespace isochron::index {

namespace {

std::uint32_t key(std::uint32_t row, std::uint32_t column) {
    return row << 8 | column;
}

/// Calls `f(list, i)` for all entries of two lists, alternating between the lists.
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

/// The part of span space that the entries take up.
struct CellTableBuilder::Band {
    CellTableHead head{};
    std::uint32_t span = 0; ///< largest difference of an entry's row and column
    std::array<std::uint32_t, CellTableHead::kRows> row_count{}, row_begin{}; ///< entries
    /// For each column: 1 + the last row that has an entry in this column or a lower one.
    std::array<std::uint32_t, CellTableHead::kRows> rows_end{};

    std::uint32_t first_column(std::uint32_t row) const { return row - std::min(row, span); }
    std::bitset<CellTableHead::kRows> wide; ///< columns of wide lines

    /// Number of pairs of rows, from the column's first pair to the last pair with entries in
    /// columns up to `last`.
    std::uint32_t line_pairs(std::uint32_t column, std::uint32_t last) const {
        const std::uint32_t first = CellTableLayout::first_pair(head, column);
        return std::max(first, (rows_end[last] + 1) / 2) - first;
    }
    /// Size of a line in units of u16.
    std::uint32_t line_size(std::uint32_t column) const {
        return line_pairs(column, column) << int{wide[column]};
    }
    /// Calls `f` with the number and the pairs of every base line; a base line that only wide lines
    /// would use is empty.
    template <class F>
    void for_each_base(F&& f) const {
        const std::uint32_t first = CellTableLayout::first_base(head);
        for (std::uint32_t i = 0; i < CellTableLayout::base_lines(head); ++i) {
            const std::uint32_t begin = (first + i) << head.form;
            const std::uint32_t end = std::min(begin + (1u << head.form), head.last_row + 1u);
            bool used = false;
            for (std::uint32_t column = std::max<std::uint32_t>(begin, head.first_column);
                 column < end; ++column)
                used |= !wide[column];
            f(i, used && begin > head.first_column ? line_pairs(begin, begin - 1) : 0);
        }
    }
};

CellTableBuilder::CellTableBuilder() {
    for (auto& counts : counts_)
        counts.resize(std::size_t{CellTableHead::kRows} * CellTableHead::kRows);
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
    for (std::uint32_t column = first_column, end = 0; column <= last_row; ++column)
        band.rows_end[column] = end = std::max(end, band.rows_end[column]);
    choose_lines(band);
    CellTableHead sparse = band.head;
    sparse.form = CellTableHead::kSparse;
    sparse.size = static_cast<std::uint16_t>(elements);
    sparse.base_size = 0;
    // A search in lines is faster than in more than a few elements, so lines are chosen even if
    // they take a little more room.
    const std::size_t lines_size = CellTableLayout(band.head).end;
    const std::size_t most =
        elements <= CellTableHead::kMaxElements / 4 ? lines_size : lines_size * 3 / 4;
    if (elements <= CellTableHead::kMaxElements && band.head.entries <= 0xffff &&
        CellTableLayout(sparse).end <= most)
        band.head = sparse;
    band.head = with_offsets(band.head);
    return band;
}

/// Chooses the distance of base lines and the wide lines so that the table takes the fewest bytes.
void CellTableBuilder::choose_lines(Band& band) const {
    constexpr std::array<std::uint8_t, 4> kForms{8, 4, 3, 2};
    std::array<std::bitset<CellTableHead::kRows>, kForms.size()> wide;
    for (std::uint32_t row = band.head.first_row; row <= band.head.last_row; ++row) {
        if (band.row_count[row] <= 0xff)
            continue;
        std::array<std::uint32_t, kForms.size()> base{};
        std::uint32_t length = 0;
        // A line's first pair may have an even row that lies before the column.
        const std::uint32_t last = std::min<std::uint32_t>(row | 1, band.head.last_row);
        for (std::uint32_t column = band.first_column(row); column <= last; ++column) {
            const std::uint32_t before = length, k = key(row, column);
            if (column <= row)
                length += std::uint32_t{counts_[0][k]} + counts_[1][k];
            for (std::size_t i = 0; i < kForms.size(); ++i) {
                if (column % (1u << kForms[i]) == 0)
                    base[i] = before;
                if (length - base[i] > 0xff)
                    wide[i].set(column);
            }
        }
    }
    std::uint32_t least = 0xffffffff;
    Band best = band;
    for (std::size_t i = 0; i < kForms.size(); ++i) {
        band.head.form = kForms[i];
        band.wide = wide[i];
        std::uint32_t size = 0, base_size = 0;
        for (std::uint32_t column = band.head.first_column; column <= band.head.last_row; ++column)
            size += band.line_size(column);
        band.for_each_base([&](std::uint32_t, std::uint32_t pairs) { base_size += pairs; });
        if (size + 2 * base_size < least) {
            least = size + 2 * base_size;
            band.head.size = static_cast<std::uint16_t>(size);
            band.head.base_size = static_cast<std::uint16_t>(base_size);
            best = band;
        }
    }
    band = best;
}

/// Writes the whole table. @param table bytes that are 0
void CellTableBuilder::write(const Band& band, std::byte* table) {
    std::memcpy(table, &band.head, sizeof band.head);
    const CellTableLayout layout(band.head);
    if (band.head.form == CellTableHead::kSparse)
        write_elements(band, layout, table);
    else
        write_lines(band, layout, table);
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

/// Turns the counts of a row's elements into the places of their first entries in the row.
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

void CellTableBuilder::write_lines(const Band& band, const CellTableLayout& layout,
                                   std::byte* table) {
    const CellTableHead& head = band.head;
    std::byte* anchor = table + layout.anchors;
    auto* starts = reinterpret_cast<std::uint16_t*>(table + layout.starts);
    auto* wide = reinterpret_cast<std::uint8_t*>(table + layout.wide);
    auto* base_starts = reinterpret_cast<std::uint16_t*>(table + layout.base_starts);
    auto* bases = reinterpret_cast<std::uint16_t*>(table + layout.bases);
    auto* lengths = reinterpret_cast<std::uint16_t*>(table + layout.lengths);
    for (std::uint32_t even = head.first_row & ~1u; even <= head.last_row; even += 2) {
        const std::uint32_t place = band.row_begin[even] + band.row_count[even];
        const std::size_t size = CellTableLayout::short_anchors(head) ? 2 : 4;
        std::memcpy(anchor, &place, size); // little-endian
        anchor += size;
    }
    for (std::uint32_t i = 0; i < CellTableLayout::lines(head); ++i) {
        const std::uint32_t column = head.first_column + i;
        starts[i + 1] = static_cast<std::uint16_t>(starts[i] + band.line_size(column));
        wide[i / 8] = static_cast<std::uint8_t>(wide[i / 8] | int{band.wide[column]} << i % 8);
    }
    band.for_each_base([&](std::uint32_t i, std::uint32_t pairs) {
        base_starts[i + 1] = static_cast<std::uint16_t>(base_starts[i] + pairs);
    });

    const std::uint32_t block = 1u << head.form;
    for (std::uint32_t row = head.first_row; row <= head.last_row; ++row) {
        if (band.row_count[row] == 0)
            continue;
        std::uint32_t length = 0, base = 0;
        // A line's first pair may have an even row that lies before the column.
        const std::uint32_t last = std::min<std::uint32_t>(row | 1, head.last_row);
        for (std::uint32_t column = band.first_column(row); column <= last; ++column) {
            const std::uint32_t pair = row / 2 - CellTableLayout::first_pair(head, column);
            if (column % block == 0 && length > 0) {
                base = length;
                const std::uint32_t i = column / block - CellTableLayout::first_base(head);
                if (base_starts[i] != base_starts[i + 1])
                    bases[2 * (base_starts[i] + pair) + row % 2] = static_cast<std::uint16_t>(base);
            }
            const std::uint32_t k = key(row, column);
            if (column <= row)
                length += std::uint32_t{counts_[0][k]} + counts_[1][k];
            if (length == 0)
                continue;
            std::uint16_t* line = lengths + starts[column - head.first_column];
            if (band.wide[column])
                line[2 * pair + row % 2] = static_cast<std::uint16_t>(length);
            else
                reinterpret_cast<std::uint8_t*>(line)[2 * pair + row % 2] =
                    static_cast<std::uint8_t>(length - base);
        }
        place_row(band, row, [](auto...) {});
    }
}

CellTableHead CellTableBuilder::append_to(std::vector<std::byte>& bytes) {
    assert(entries_.count() > 0 && bytes.size() % CellTableHead::kAlignment == 0);
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
