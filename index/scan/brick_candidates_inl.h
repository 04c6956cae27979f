// Finds the bricks that may hold active cells by their extremes; compiled once for each SIMD
// target.
#include "index/scan/vertex_bits_inl.h"
#include "index/volume/level_map.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <type_traits>

// Highway's guard: the file is read again for every target.
#if defined(ISOCHRON_INDEX_BRICK_CANDIDATES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ISOCHRON_INDEX_BRICK_CANDIDATES_INL_H
#undef ISOCHRON_INDEX_BRICK_CANDIDATES_INL_H
#else
#define ISOCHRON_INDEX_BRICK_CANDIDATES_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {

/// The candidates: bricks that may hold active cells.
class Candidates {
  public:
    Candidates(std::span<const std::uint8_t> bricks, const LevelMap::Cut& cut)
        : count_(bricks.size() / 2), low_(bricks.data()), high_(low_ + count_),
          threshold_(cut.threshold),
          highest_low_(static_cast<std::uint8_t>(cut.threshold - (cut.exact ? 1 : 0))) {}

    /// Number of all bricks, candidates or not.
    std::size_t bricks() const { return count_; }

    /// A bit for each of the 64 bricks from `first` on: whether it is a candidate.
    HWY_INLINE std::uint64_t word(std::size_t first) const {
        const std::size_t left = count_ - first;
        if (HWY_LIKELY(left >= kWordBits))
            return whole_word(low_ + first, high_ + first);
        std::array<std::uint8_t, kWordBits> low, high;
        low.fill(255); // no candidates
        high.fill(0);
        std::copy_n(low_ + first, left, low.begin());
        std::copy_n(high_ + first, left, high.begin());
        return whole_word(low.data(), high.data()) & ((std::uint64_t{1} << left) - 1);
    }

    std::size_t count() const {
        std::size_t sum = 0;
        for (std::size_t first = 0; first < count_; first += kWordBits)
            sum += hwy::PopCount(word(first));
        return sum;
    }

    /// Calls `f(brick)` for every candidate, ascending.
    template <class F>
    HWY_INLINE void for_each(const F& f) const {
        for (std::size_t first = 0; first < count_; first += kWordBits)
            for (std::uint64_t bits = word(first); bits; bits &= bits - 1)
                f(static_cast<std::uint32_t>(first + hwy::Num0BitsBelowLS1Bit_Nonzero64(bits)));
    }

    /// Calls `expect(brick)`, and `f` with what it returned when the next `kAhead` candidates are
    /// expected, too: that gives a brick's data time to come from memory.
    template <std::size_t kAhead, class Expect, class F>
    HWY_INLINE void for_each_ahead(const Expect& expect, const F& f) const {
        std::array<std::invoke_result_t<const Expect&, std::uint32_t>, kAhead> waiting{};
        std::size_t found = 0;
        for_each([&](std::uint32_t brick) HWY_ATTR {
            const auto expected = expect(brick);
            if (found >= kAhead)
                f(waiting[found % kAhead]);
            waiting[found++ % kAhead] = expected;
        });
        for (std::size_t i = found - std::min(found, kAhead); i < found; ++i)
            f(waiting[i % kAhead]);
    }

  private:
    HWY_INLINE std::uint64_t whole_word(const std::uint8_t* low, const std::uint8_t* high) const {
        const hn::CappedTag<std::uint8_t, kWordBits> d;
        std::uint64_t bits = 0;
        for (std::size_t i = 0; i < kWordBits; i += hn::Lanes(d)) {
            const auto above = hn::Gt(hn::LoadU(d, low + i), hn::Set(d, highest_low_));
            const auto below = hn::Lt(hn::LoadU(d, high + i), hn::Set(d, threshold_));
            bits |= bits_of(d, hn::Not(hn::Or(above, below))) << i;
        }
        return bits;
    }

    std::size_t count_;
    const std::uint8_t* low_;
    const std::uint8_t* high_;
    std::uint8_t threshold_, highest_low_;
};

} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
