// Search in the table of one chunk's cells, and its check.
#include "index/cell_table.h"

#include "index/cell_table_layout.h"

#include <array>
#include <bit>
#include <cstring>

namespace isochron::index {
namespace {

static_assert(std::endian::native == std::endian::little);

template <class T>
const T* at(const std::byte* bytes, std::size_t offset) {
    return reinterpret_cast<const T*>(bytes + offset);
}

/// Collects the runs of one table, since growing a vector by one costs more than a run.
class Runs {
  public:
    Runs(const std::uint16_t* ids, CellId first) : ids_(ids), first_(first) {}

    void add(std::uint32_t begin, std::uint32_t count) {
        runs_[count_] = {ids_ + begin, count, first_};
        count_ += count != 0; // without a branch: an empty run is overwritten
    }
    void append_to(std::vector<IdRun>& out) const {
        out.insert(out.end(), runs_.begin(), runs_.begin() + count_);
    }

  private:
    std::array<IdRun, CellTable::kRows + 1> runs_;
    std::size_t count_ = 0;
    const std::uint16_t* ids_;
    CellId first_;
};

} // namespace

struct CellTable::Sparse {
    Sparse(const std::byte* bytes, const CellTableHead& head_, const CellTableLayout& layout)
        : head(head_), columns(at<std::uint8_t>(bytes, layout.columns)),
          rows(at<std::uint8_t>(bytes, layout.rows)),
          begins(at<std::uint16_t>(bytes, layout.begins)) {}

    const CellTableHead& head;
    const std::uint8_t *columns, *rows;
    const std::uint16_t* begins;

    bool check() const {
        if (head.size == 0 || begins[0] != 0 || begins[head.size] != head.entries)
            return false;
        return std::is_sorted(begins, begins + head.size + 1);
    }

    void up_to(std::uint32_t column, Rows wanted, Runs& out) const {
        between(-1, column, wanted, out);
    }

    void between(std::int32_t below, std::uint32_t column, Rows wanted, Runs& out) const {
        alignas(64) std::array<std::uint8_t, kMaxElements + 8> hit;
        const auto lowest_column = static_cast<std::uint8_t>(below + 1),
                   highest_column = static_cast<std::uint8_t>(column),
                   lowest_row = static_cast<std::uint8_t>(wanted.begin),
                   highest_row = static_cast<std::uint8_t>(wanted.end - 1);
        for (std::uint32_t e = 0; e < head.size; ++e)
            hit[e] = (columns[e] >= lowest_column) & (columns[e] <= highest_column) &
                     (rows[e] >= lowest_row) & (rows[e] <= highest_row);
        std::memset(hit.data() + head.size, 0, 8);
        // Neighbouring elements make one run, also from one pair of rows to the next.
        std::uint32_t begin = 0, end = 0;
        for (std::uint32_t e = 0; e < head.size; e += 8) {
            std::uint64_t eight;
            std::memcpy(&eight, hit.data() + e, 8);
            for (; eight; eight &= eight - 1) {
                const std::uint32_t element =
                    e + static_cast<std::uint32_t>(std::countr_zero(eight)) / 8;
                if (begins[element] != end) {
                    out.add(begin, end - begin);
                    begin = begins[element];
                }
                end = begins[element + 1];
            }
        }
        out.add(begin, end - begin);
    }
};

template <class Length>
struct CellTable::Dense {
    Dense(const std::byte* bytes, const CellTableHead& head_, const CellTableLayout& layout)
        : head(head_), anchors(at<std::uint32_t>(bytes, layout.anchors)),
          starts(at<std::uint16_t>(bytes, layout.starts)),
          lengths(at<Length>(bytes, layout.lengths)) {}

    const CellTableHead& head;
    const std::uint32_t* anchors;
    const std::uint16_t* starts;
    const Length* lengths;

    /// Lengths of the pairs of rows `first` to `end - 1`.
    struct Line {
        std::uint32_t first = 0, end = 0;
        const Length* lengths = nullptr;

        std::uint32_t even(std::uint32_t pair) const { return lengths[2 * (pair - first)]; }
        std::uint32_t odd(std::uint32_t pair) const { return lengths[2 * (pair - first) + 1]; }
        bool covers(std::uint32_t pair) const { return first <= pair && pair < end; }
    };
    Line line(std::int64_t column) const {
        if (column < head.first_column || column > head.last_row)
            return {};
        const std::uint16_t* start = starts + (column - head.first_column);
        const std::uint32_t first =
            CellTableLayout::first_pair(head, static_cast<std::uint32_t>(column));
        return {first, first + start[1] - start[0], lengths + 2 * std::size_t{start[0]}};
    }
    std::uint32_t anchor(std::uint32_t pair) const {
        return anchors[pair - CellTableLayout::first_pair(head)];
    }

    bool check() const {
        const std::uint32_t pairs_end = head.last_row / 2u + 1;
        const std::uint32_t lines = CellTableLayout::lines(head);
        if (starts[0] != 0 || starts[lines] != head.size ||
            !std::is_sorted(starts, starts + lines + 1))
            return false;
        Line before;
        for (std::uint32_t i = 0; i < lines; ++i) {
            const Line now = line(head.first_column + std::int64_t{i});
            if (now.end > pairs_end || (now.first < before.end && now.end < before.end))
                return false;
            for (std::uint32_t pair = now.first; pair < now.end; ++pair) {
                if (now.even(pair) > anchor(pair) || anchor(pair) > head.entries ||
                    now.odd(pair) > head.entries - anchor(pair))
                    return false;
                if (before.covers(pair) &&
                    (now.even(pair) < before.even(pair) || now.odd(pair) < before.odd(pair)))
                    return false;
            }
            before = now;
        }
        return true;
    }

    void up_to(std::uint32_t column, Rows rows, Runs& out) const {
        const Line now = line(column);
        const std::uint32_t begin = std::max(now.first, rows.begin / 2);
        const std::uint32_t end = std::min(now.end, (rows.end + 1) / 2);
        if (begin >= end)
            return;
        const Wanted wanted(rows);
        const auto add = [&](std::uint32_t pair, std::uint32_t even, std::uint32_t odd) {
            out.add(anchor(pair) - even, even + odd);
        };
        add(begin, wanted.even(begin) ? now.even(begin) : 0,
            wanted.odd(begin) ? now.odd(begin) : 0);
        if (end - begin == 1)
            return;
        for (std::uint32_t pair = begin + 1; pair + 1 < end; ++pair)
            add(pair, now.even(pair), now.odd(pair));
        add(end - 1, now.even(end - 1), wanted.odd(end - 1) ? now.odd(end - 1) : 0);
    }

    void between(std::int32_t below, std::uint32_t column, Rows rows, Runs& out) const {
        const Line now = line(column), before = line(below);
        const Wanted wanted(rows);
        const std::uint32_t end = std::min(now.end, (rows.end + 1) / 2);
        for (std::uint32_t pair = std::max(now.first, rows.begin / 2); pair < end; ++pair) {
            const bool covered = before.covers(pair);
            if (wanted.even(pair))
                out.add(anchor(pair) - now.even(pair),
                        now.even(pair) - (covered ? before.even(pair) : 0));
            if (wanted.odd(pair)) {
                const std::uint32_t skipped = covered ? before.odd(pair) : 0;
                out.add(anchor(pair) + skipped, now.odd(pair) - skipped);
            }
        }
    }

  private:
    struct Wanted {
        explicit Wanted(Rows rows_) : rows(rows_) {}
        bool even(std::uint32_t pair) const {
            return 2 * pair >= rows.begin && 2 * pair < rows.end;
        }
        bool odd(std::uint32_t pair) const {
            return 2 * pair + 1 >= rows.begin && 2 * pair + 1 < rows.end;
        }
        Rows rows;
    };
};

template <class F>
decltype(auto) CellTable::visit(F&& f) const {
    const CellTableLayout layout(head());
    switch (head().form) {
    case CellTableHead::sparse: return f(Sparse(bytes_, head(), layout), layout);
    case CellTableHead::narrow: return f(Dense<std::uint8_t>(bytes_, head(), layout), layout);
    case CellTableHead::wide: break;
    }
    return f(Dense<std::uint16_t>(bytes_, head(), layout), layout);
}

bool CellTable::check(std::span<const std::byte> bytes, std::uint32_t cells) {
    if (bytes.size() < sizeof(CellTableHead))
        return false;
    const CellTable table(bytes.data());
    const CellTableHead& head = table.head();
    if (head.form > CellTableHead::wide || head.first_row > head.last_row ||
        head.first_column > head.last_row)
        return false;
    if (head.form == CellTableHead::sparse && head.size > kMaxElements)
        return false;
    const CellTableLayout layout(head);
    if (layout.end > bytes.size())
        return false;
    const std::uint16_t* ids = at<std::uint16_t>(bytes.data(), layout.ids);
    std::uint16_t highest = 0;
    for (std::uint32_t i = 0; i < head.entries; ++i)
        highest = std::max(highest, ids[i]);
    return highest < cells && table.visit([](const auto& directory, const CellTableLayout&) {
        return directory.check();
    });
}

std::size_t CellTable::size() const {
    return CellTableLayout(head()).end;
}

void CellTable::up_to(std::uint32_t column, Rows rows, CellId first,
                      std::vector<IdRun>& out) const {
    if (rows.begin >= rows.end)
        return;
    visit([&](const auto& directory, const CellTableLayout& layout) {
        Runs runs(at<std::uint16_t>(bytes_, layout.ids), first);
        directory.up_to(column, rows, runs);
        runs.append_to(out);
    });
}

void CellTable::between(std::int32_t below, std::uint32_t column, Rows rows, CellId first,
                        std::vector<IdRun>& out) const {
    if (rows.begin >= rows.end)
        return;
    visit([&](const auto& directory, const CellTableLayout& layout) {
        Runs runs(at<std::uint16_t>(bytes_, layout.ids), first);
        directory.between(below, column, rows, runs);
        runs.append_to(out);
    });
}

} // namespace isochron::index
