// The two kinds of directory of a cell table, with their search and checks.
#pragma once

#include "index/cells/cell_table_layout.h"
#include "index/cells/id_runs.h"

#include <array>
#include <bit>
#include <cstring>

namespace isochron::index {

static_assert(std::endian::native == std::endian::little);

template <class T>
const T* part_at(const std::byte* table, std::size_t offset) {
    return reinterpret_cast<const T*>(table + offset);
}

/// Collects the runs of one table.
class TableRuns {
  public:
    TableRuns(const std::uint16_t* ids, CellId first, RunBuffer& out)
        : ids_(ids), first_(first), out_(out), next_(out.room(CellTableHead::kRows + 1)) {}
    ~TableRuns() { out_.took(next_); }
    TableRuns(const TableRuns&) = delete;
    TableRuns& operator=(const TableRuns&) = delete;

    void add(std::uint32_t begin, std::uint32_t count) {
        *next_ = {ids_ + begin, count, first_};
        next_ += count != 0; // without a branch: an empty run is overwritten
    }

  private:
    const std::uint16_t* ids_;
    CellId first_;
    RunBuffer& out_;
    IdRun* next_;
};

/// A list of elements.
class ElementList {
  public:
    ElementList(const std::byte* table, const CellTableHead& head)
        : head_(head), columns_(part_at<std::uint8_t>(table, sizeof head)),
          rows_(columns_ + head.size),
          begins_(part_at<std::uint16_t>(table, sizeof head + 2 * std::size_t{head.size})) {}

    bool check() const {
        if (head_.size == 0 || begins_[0] != 0 || begins_[head_.size] != head_.entries)
            return false;
        return std::is_sorted(begins_, begins_ + head_.size + 1);
    }

    void up_to(std::uint32_t column, SpanRows wanted, TableRuns& out) const {
        between(-1, column, wanted, out);
    }

    void between(std::int32_t below, std::uint32_t column, SpanRows wanted, TableRuns& out) const {
        alignas(64) std::array<std::uint8_t, CellTableHead::kMaxElements + 8> hit;
        const auto lowest_column = static_cast<std::uint8_t>(below + 1),
                   highest_column = static_cast<std::uint8_t>(column),
                   lowest_row = static_cast<std::uint8_t>(wanted.begin),
                   highest_row = static_cast<std::uint8_t>(wanted.end - 1);
        for (std::uint32_t e = 0; e < head_.size; ++e)
            hit[e] = (columns_[e] >= lowest_column) & (columns_[e] <= highest_column) &
                     (rows_[e] >= lowest_row) & (rows_[e] <= highest_row);
        std::memset(hit.data() + head_.size, 0, 8);
        // Neighboring elements make one run, even across pairs of rows.
        std::uint32_t begin = 0, end = 0;
        for (std::uint32_t e = 0; e < head_.size; e += 8) {
            std::uint64_t eight;
            std::memcpy(&eight, hit.data() + e, 8);
            for (; eight; eight &= eight - 1) {
                const std::uint32_t element =
                    e + static_cast<std::uint32_t>(std::countr_zero(eight)) / 8;
                if (begins_[element] != end) {
                    out.add(begin, end - begin);
                    begin = begins_[element];
                }
                end = begins_[element + 1];
            }
        }
        out.add(begin, end - begin);
    }

  private:
    const CellTableHead& head_;
    const std::uint8_t *columns_, *rows_;
    const std::uint16_t* begins_;
};

/// A line of lengths for each column.
class LengthLines {
  public:
    LengthLines(const std::byte* table, const CellTableHead& head)
        : head_(head), first_pair_(CellTableLayout::first_pair(head)),
          short_anchors_(CellTableLayout::short_anchors(head)), anchors_(table + sizeof head),
          starts_(part_at<std::uint16_t>(table, head.starts)),
          base_starts_(part_at<std::uint16_t>(table, head.base_starts)),
          bases_(part_at<std::uint16_t>(table, head.bases)),
          lengths_(part_at<std::uint16_t>(table, head.lengths)),
          wide_(part_at<std::uint8_t>(table, head.wide)) {}

    bool check() const {
        if (!ascends(starts_, CellTableLayout::lines(head_), head_.size) ||
            !ascends(base_starts_, CellTableLayout::base_lines(head_), head_.base_size))
            return false;
        for (std::uint32_t column = head_.first_column; column <= head_.last_row; ++column) {
            const Line of_column = line(column);
            if (of_column.wide ? !check<std::uint16_t>(of_column) : !check<std::uint8_t>(of_column))
                return false;
        }
        return true;
    }

    void up_to(std::uint32_t column, SpanRows rows, TableRuns& out) const {
        const Line now = line(column);
        const std::uint32_t begin = std::max(now.first, rows.begin / 2);
        if (begin >= std::min(now.end, (rows.end + 1) / 2))
            return;
        // Only the first and the last pair may have an unwanted row.
        add_wanted(now, begin, rows, out);
        const std::uint32_t end = std::min(now.end, rows.end / 2);
        const std::uint32_t base_end = std::min(end, now.base_end);
        std::uint32_t pair = begin + 1;
        if (now.wide)
            for (; pair < end; ++pair)
                add(pair, now.at<std::uint16_t>(pair, 0), now.at<std::uint16_t>(pair, 1), out);
        for (; pair < base_end; ++pair)
            add(pair, now.at<std::uint8_t>(pair, 0) + now.base(pair, 0),
                now.at<std::uint8_t>(pair, 1) + now.base(pair, 1), out);
        for (; pair < end; ++pair)
            add(pair, now.at<std::uint8_t>(pair, 0), now.at<std::uint8_t>(pair, 1), out);
        if (rows.end % 2 == 1 && begin < rows.end / 2 && rows.end / 2 < now.end)
            add_wanted(now, rows.end / 2, rows, out);
    }

    void between(std::int32_t below, std::uint32_t column, SpanRows rows, TableRuns& out) const {
        const Line now = line(column);
        const Line before = below < 0 ? Line{} : line(static_cast<std::uint32_t>(below));
        const std::uint32_t end = std::min(now.end, (rows.end + 1) / 2);
        for (std::uint32_t pair = std::max(now.first, rows.begin / 2); pair < end; ++pair) {
            // In a damaged table the line before may be longer.
            const std::uint32_t even = now.length(pair, 0), odd = now.length(pair, 1);
            const std::uint32_t skipped_even = std::min(before.length(pair, 0), even),
                                skipped_odd = std::min(before.length(pair, 1), odd);
            if (wanted(rows, 2 * pair))
                out.add(anchor(pair) - even, even - skipped_even);
            if (wanted(rows, 2 * pair + 1))
                out.add(anchor(pair) + skipped_odd, odd - skipped_odd);
        }
    }

  private:
    /// Lengths of the pairs of rows `first` to `end - 1`; those from `base_end` on have no base.
    struct Line {
        std::uint32_t first = 0, end = 0, base_end = 0;
        bool wide = false;
        const std::uint16_t *lengths = nullptr, *bases = nullptr;

        template <class Length>
        std::uint32_t at(std::uint32_t pair, int odd) const {
            return reinterpret_cast<const Length*>(lengths)[2 * (pair - first) + odd];
        }
        std::uint32_t base(std::uint32_t pair, int odd) const {
            return bases[2 * (pair - first) + odd];
        }
        template <class Length>
        std::uint32_t sum(std::uint32_t pair, int odd) const {
            return at<Length>(pair, odd) + (pair < base_end ? base(pair, odd) : 0);
        }
        std::uint32_t length(std::uint32_t pair, int odd) const {
            if (pair < first || pair >= end)
                return 0;
            return wide ? sum<std::uint16_t>(pair, odd) : sum<std::uint8_t>(pair, odd);
        }
    };

    Line line(std::uint32_t column) const {
        Line line;
        if (column < head_.first_column || column > head_.last_row)
            return line;
        const std::uint32_t i = column - head_.first_column;
        line.wide = wide_[i / 8] >> i % 8 & 1;
        line.lengths = lengths_ + starts_[i];
        line.first = CellTableLayout::first_pair(head_, column);
        line.end = line.first + ((starts_[i + 1] - starts_[i]) >> int{line.wide});
        if (line.wide)
            return line;
        const std::uint32_t base = column >> head_.form;
        const std::uint16_t* base_start =
            base_starts_ + (base - CellTableLayout::first_base(head_));
        const std::uint32_t first = CellTableLayout::first_pair(head_, base << head_.form);
        line.base_end = first + base_start[1] - base_start[0];
        // The base line is of an earlier column, so it begins at an earlier pair of rows.
        line.bases = bases_ + (2 * (std::size_t{base_start[0]} + line.first - first));
        return line;
    }
    std::uint32_t anchor(std::uint32_t pair) const {
        const std::size_t i = pair - first_pair_;
        return short_anchors_ ? part_at<std::uint16_t>(anchors_, 0)[i]
                              : part_at<std::uint32_t>(anchors_, 0)[i];
    }

    static bool wanted(SpanRows rows, std::uint32_t row) {
        return rows.begin <= row && row < rows.end;
    }
    void add_wanted(const Line& line, std::uint32_t pair, SpanRows rows, TableRuns& out) const {
        add(pair, wanted(rows, 2 * pair) ? line.length(pair, 0) : 0,
            wanted(rows, 2 * pair + 1) ? line.length(pair, 1) : 0, out);
    }
    void add(std::uint32_t pair, std::uint32_t even, std::uint32_t odd, TableRuns& out) const {
        out.add(anchor(pair) - even, even + odd);
    }

    static bool ascends(const std::uint16_t* starts, std::uint32_t count, std::uint32_t last) {
        return starts[0] == 0 && starts[count] == last &&
               std::is_sorted(starts, starts + count + 1);
    }
    /// Whether the line and its base line cover only existing rows and lead only to existing
    /// entries.
    template <class Length>
    bool check(const Line& line) const {
        const std::uint32_t pairs_end = first_pair_ + CellTableLayout::pairs(head_);
        if (line.end > pairs_end || line.base_end > pairs_end)
            return false;
        bool sound = true; // without a branch for each pair
        for (std::uint32_t pair = line.first; pair < line.end; ++pair)
            sound &= line.sum<Length>(pair, 0) <= anchor(pair) &&
                     std::uint64_t{anchor(pair)} + line.sum<Length>(pair, 1) <= head_.entries;
        return sound;
    }

    const CellTableHead& head_;
    std::uint32_t first_pair_;
    bool short_anchors_;
    const std::byte* anchors_;
    const std::uint16_t *starts_, *base_starts_, *bases_, *lengths_;
    const std::uint8_t* wide_;
};

} // namespace isochron::index
