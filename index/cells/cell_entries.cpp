// Selects the cells that become entries of a table, a SIMD vector at a time; compiled once for each
// SIMD target.
#include "index/cells/cell_entries.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "index/cells/cell_entries.cpp"
#include <hwy/foreach_target.h>

#include "index/system/compress_inl.h"

#include <algorithm>
#include <cassert>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {

using Extremes = StretchRanks::Extremes;

constexpr std::size_t kWordBits = 64;
using Bytes = hn::CappedTag<std::uint8_t, kWordBits>;
using Shorts = hn::CappedTag<std::uint16_t, kWordBits / 2>;
using HalfBytes = hn::Rebind<std::uint8_t, Shorts>;

/// A bit for each of the 64 cells from `i` on: whether its extremes are the same.
HWY_INLINE std::uint64_t same(const Extremes& a, const Extremes& b, std::size_t i) {
    const Bytes d;
    std::uint64_t word = 0;
    for (std::size_t at = 0; at < kWordBits; at += hn::Lanes(d)) {
        const auto equal = [&](std::span<const std::uint8_t> x, std::span<const std::uint8_t> y) {
            return hn::Eq(hn::LoadU(d, x.data() + i + at), hn::LoadU(d, y.data() + i + at));
        };
        word |= bits_of(d, hn::And(equal(a.low, b.low), equal(a.high, b.high))) << at;
    }
    return word;
}

/// A bit for each of the 64 cells from `i` on: whether it is active at some isovalue.
HWY_INLINE std::uint64_t active(const Extremes& extremes, std::size_t i) {
    const Bytes d;
    std::uint64_t word = 0;
    for (std::size_t at = 0; at < kWordBits; at += hn::Lanes(d)) {
        word |= bits_of(d, hn::Lt(hn::LoadU(d, extremes.low.data() + i + at),
                                  hn::LoadU(d, extremes.high.data() + i + at)))
                << at;
    }
    return word;
}

std::size_t join_spans(const Extremes& a, const Extremes& b, std::uint64_t* left,
                       std::uint64_t* right, std::uint64_t* joined, std::size_t words) {
    std::size_t count = 0;
    for (std::size_t word = 0; word < words; ++word) {
        const std::uint64_t both = left[word] & right[word];
        joined[word] = both ? both & same(a, b, word * kWordBits) : 0;
        left[word] &= ~joined[word];
        right[word] &= ~joined[word];
        if (joined[word])
            count += hwy::PopCount(joined[word] & active(a, word * kWordBits));
    }
    return count;
}

void find_changes(const Extremes& a, const Extremes& b, std::uint64_t* changed, std::size_t words) {
    for (std::size_t word = 0; word < words; ++word)
        changed[word] = ~same(a, b, word * kWordBits);
}

/// Writes entries to a list, and updates their bounds.
class Writer {
  public:
    using V = hn::Vec<Shorts>;
    using M = hn::Mask<Shorts>;

    explicit Writer(CellEntries::List& list)
        : keys_(list.keys.data()), ids_(list.ids.data()), count_(list.count) {}

    HWY_INLINE void add(M chosen, V row, V column, V id) {
        const V key = hn::Or(hn::ShiftLeft<8>(row), column);
        store_chosen(kD, key, chosen, keys_ + count_);
        count_ += static_cast<std::uint32_t>(store_chosen(kD, id, chosen, ids_ + count_));
        const V none = hn::Set(kD, 0xff);
        first_column_ = hn::Min(first_column_, hn::IfThenElse(chosen, column, none));
        first_row_ = hn::Min(first_row_, hn::IfThenElse(chosen, row, none));
        last_row_ = hn::Max(last_row_, hn::IfThenElseZero(chosen, row));
        span_ = hn::Max(span_, hn::IfThenElseZero(chosen, hn::Sub(row, column)));
    }
    void finish(CellEntries::List& list, CellEntries::Bounds& bounds) const {
        list.count = count_;
        std::array<std::uint16_t, kWordBits> lanes;
        const auto fold = [&](V v, std::uint8_t& into, auto&& choose) {
            hn::StoreU(v, kD, lanes.data());
            for (std::size_t i = 0; i < hn::Lanes(kD); ++i)
                into = choose(into, static_cast<std::uint8_t>(lanes[i]));
        };
        const auto lower = [](std::uint8_t a, std::uint8_t b) { return std::min(a, b); };
        const auto higher = [](std::uint8_t a, std::uint8_t b) { return std::max(a, b); };
        fold(first_column_, bounds.first_column, lower);
        fold(first_row_, bounds.first_row, lower);
        fold(last_row_, bounds.last_row, higher);
        fold(span_, bounds.span, higher);
    }

  private:
    static constexpr Shorts kD{};
    std::uint16_t *keys_, *ids_;
    std::uint32_t count_;
    V first_column_ = hn::Set(kD, 0xff), first_row_ = hn::Set(kD, 0xff), last_row_ = hn::Zero(kD),
      span_ = hn::Zero(kD);
};

/// Calls `f(i, mask)` for every vector of cells with at least one chosen cell.
template <class F>
HWY_INLINE void for_each_chosen(const std::uint64_t* chosen, std::size_t first_word,
                                std::size_t end_word, F&& f) {
    const Shorts d;
    for (std::size_t word = first_word; word < end_word; ++word)
        for (std::size_t at = 0; chosen[word] >> at; at += hn::Lanes(d)) {
            const std::uint64_t bits = chosen[word] >> at;
            f(word * kWordBits + at,
              hn::LoadMaskBits(d, reinterpret_cast<const std::uint8_t*>(&bits)));
            if (at + hn::Lanes(d) == kWordBits)
                break;
        }
}

HWY_INLINE hn::Vec<Shorts> load(std::span<const std::uint8_t> ranks, std::size_t i) {
    return hn::PromoteTo(Shorts(), hn::LoadU(HalfBytes(), ranks.data() + i));
}

void select_cells(const Extremes& extremes, const std::uint64_t* chosen, std::size_t words,
                  bool lossless, CellEntries& out) {
    const Shorts d;
    const auto one_less = hn::Set(d, static_cast<std::uint16_t>(lossless));
    std::size_t first = 0;
    for (CellEntries::List& list : out.lists) {
        const std::size_t end = &list == &out.lists.back() ? words : words / 2;
        Writer writer(list);
        for_each_chosen(chosen, first, end, [&](std::size_t i, hn::Mask<Shorts> mask) HWY_ATTR {
            const auto low = load(extremes.low, i), high = load(extremes.high, i);
            const auto active = hn::Not(hn::Gt(hn::Add(low, one_less), high));
            writer.add(hn::And(mask, active), hn::Sub(high, one_less), low,
                       hn::Iota(d, static_cast<std::uint16_t>(i)));
        });
        writer.finish(list, out.bounds);
        first = end;
    }
}

void select_differences(const Extremes& from, const Extremes& to, const std::uint64_t* chosen,
                        std::size_t words, CellEntries& out) {
    const Shorts d;
    const auto one = hn::Set(d, 1);
    Writer below(out.lists[0]), above(out.lists[1]);
    for_each_chosen(chosen, 0, words, [&](std::size_t i, hn::Mask<Shorts> mask) HWY_ATTR {
        const auto low = load(to.low, i), high = load(to.high, i);
        const auto other_low = load(from.low, i), other_high = load(from.high, i);
        // An empty interval to subtract becomes one that begins at the end of the other interval.
        const auto empty = hn::Not(hn::Lt(other_low, other_high));
        const auto from_low = hn::IfThenElse(empty, high, other_low);
        const auto from_high = hn::IfThenElse(empty, high, other_high);
        const auto active = hn::And(mask, hn::Lt(low, high));
        const auto id = hn::Iota(d, static_cast<std::uint16_t>(i));
        below.add(hn::And(active, hn::Lt(low, from_low)), hn::Sub(hn::Min(high, from_low), one),
                  low, id);
        above.add(hn::And(active, hn::Gt(high, from_high)), hn::Sub(high, one),
                  hn::Max(low, from_high), id);
    });
    below.finish(out.lists[0], out.bounds);
    above.finish(out.lists[1], out.bounds);
}

} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isochron::index {

HWY_EXPORT(join_spans);
HWY_EXPORT(find_changes);
HWY_EXPORT(select_cells);
HWY_EXPORT(select_differences);

static_assert(StretchRanks::kSlack >= 63);

CellEntries::CellEntries() {
    constexpr std::size_t kVector = 32; // entries that may be written after the last
    for (List& list : lists) {
        list.keys.resize(Stretches::kMaxCells + kVector);
        list.ids.resize(Stretches::kMaxCells + kVector);
    }
}

std::size_t join_spans(const StretchRanks::Extremes& a, const StretchRanks::Extremes& b,
                       CellBits& left, CellBits& right, CellBits& joined) {
    return HWY_DYNAMIC_DISPATCH(join_spans)(a, b, left.data(), right.data(), joined.data(),
                                            joined.size());
}

void find_changes(const StretchRanks::Extremes& a, const StretchRanks::Extremes& b,
                  CellBits& changed) {
    HWY_DYNAMIC_DISPATCH(find_changes)(a, b, changed.data(), changed.size());
    if (const std::size_t past = a.low.size() % 64)
        changed.back() &= (std::uint64_t{1} << past) - 1;
}

void select_cells(const StretchRanks::Extremes& extremes, const CellBits& chosen, bool lossless,
                  CellEntries& out) {
    HWY_DYNAMIC_DISPATCH(select_cells)(extremes, chosen.data(), chosen.size(), lossless, out);
}

void select_differences(const StretchRanks::Extremes& from, const StretchRanks::Extremes& to,
                        const CellBits& chosen, CellEntries& out) {
    HWY_DYNAMIC_DISPATCH(select_differences)(from, to, chosen.data(), chosen.size(), out);
}

} // namespace isochron::index
#endif
