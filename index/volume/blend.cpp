// Blends by error-free sums: what rounding loses is known, so that every result is rounded down.
#include "index/volume/blend.h"

#include "index/volume/instant.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "index/volume/blend.cpp"
#include <hwy/foreach_target.h> // must come before highway.h

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::ScalableTag<double>;
using Numbers = hn::RebindToSigned<Doubles>;
using Lanes = hn::Vec<Doubles>;

struct Sum {
    Lanes sum, error; ///< both together are the exact sum
};

/// Knuth, The Art of Computer Programming 2, 4.2.2, theorem B.
HWY_INLINE Sum two_sum(Lanes a, Lanes b) {
    const Lanes sum = hn::Add(a, b);
    const Lanes of_b = hn::Sub(sum, a);
    const Lanes error = hn::Add(hn::Sub(a, hn::Sub(sum, of_b)), hn::Sub(b, of_b));
    return {sum, error};
}

/// The number before each of `values` that has `below` set. @param values not 0 there
HWY_INLINE Lanes lowered(Lanes values, hn::Mask<Doubles> below) {
    const Numbers numbers;
    const auto bits = hn::BitCast(numbers, values);
    // Towards 0 among positive numbers, away from it among negative ones.
    const auto one =
        hn::IfThenElse(hn::Lt(bits, hn::Zero(numbers)), hn::Set(numbers, 1), hn::Set(numbers, -1));
    return hn::BitCast(Doubles(),
                       hn::Add(bits, hn::IfThenElseZero(hn::RebindMask(numbers, below), one)));
}

/// 0 where a number is finite, else NaN.
HWY_INLINE Lanes missing(Lanes value) {
    return hn::Sub(value, value);
}

/// Products of 24 bits and 17 bits are exact, so only their sum is rounded.
HWY_INLINE Lanes blended_single(Lanes a, Lanes b, Lanes of_a, Lanes of_b) {
    const Doubles d;
    const Sum sum = two_sum(hn::Mul(a, of_a), hn::Mul(b, of_b));
    const Lanes down = lowered(sum.sum, hn::Lt(sum.error, hn::Zero(d)));
    return hn::Add(hn::Mul(down, hn::Set(d, 1.0 / Instant::kFractions)),
                   hn::Add(missing(a), missing(b)));
}

void blend_single(const float* a, const float* b, std::size_t count, std::uint32_t n, double* out) {
    const Doubles d;
    const hn::Rebind<float, Doubles> halves;
    const std::size_t lanes = hn::Lanes(d);
    const Lanes of_a = hn::Set(d, Instant::kFractions - n), of_b = hn::Set(d, n);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes)
        hn::StoreU(blended_single(hn::PromoteTo(d, hn::LoadU(halves, a + i)),
                                  hn::PromoteTo(d, hn::LoadU(halves, b + i)), of_a, of_b),
                   d, out + i);
    for (; i < count; ++i)
        out[i] = blended(a[i], b[i], n);
}

/// Blends of f32, each an f32 on its own side of all isovalues.
void blend_sided(const float* a, const float* b, std::size_t count, std::uint32_t n,
                 std::span<const Blend::Side> sides, float* out) {
    const Doubles d;
    const hn::Rebind<float, Doubles> halves;
    const std::size_t lanes = hn::Lanes(d);
    const Lanes of_a = hn::Set(d, Instant::kFractions - n), of_b = hn::Set(d, n);
    const auto some = [&](const float* from_a, const float* from_b) HWY_ATTR {
        const Lanes first = hn::Mul(hn::PromoteTo(d, hn::LoadU(halves, from_a)), of_a);
        const Lanes second = hn::Mul(hn::PromoteTo(d, hn::LoadU(halves, from_b)), of_b);
        const Lanes sum = hn::Add(first, second); // the products are exact
        Lanes blend = hn::Mul(sum, hn::Set(d, 1.0 / Instant::kFractions));
        for (const Blend::Side& side : sides) {
            // Only at a tie does it matter what the sum was rounded by.
            const Lanes at = hn::Set(d, side.isovalue * Instant::kFractions);
            auto above = hn::Ge(sum, at);
            const auto tie = hn::Eq(sum, at);
            if (HWY_UNLIKELY(!hn::AllFalse(d, tie)))
                above = hn::AndNot(hn::And(tie, hn::Lt(two_sum(first, second).error, hn::Zero(d))),
                                   above);
            blend = hn::IfThenElse(above, hn::Max(blend, hn::Set(d, side.above)),
                                   hn::Min(blend, hn::Set(d, side.below)));
        }
        return hn::DemoteTo(halves, hn::Add(blend, missing(sum)));
    };
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes)
        hn::StoreU(some(a + i, b + i), halves, out + i);
    if (i == count)
        return;
    constexpr std::size_t kMostLanes = 64;
    std::array<float, kMostLanes> last_a{}, last_b{}, last{};
    std::copy(a + i, a + count, last_a.begin());
    std::copy(b + i, b + count, last_b.begin());
    hn::StoreU(some(last_a.data(), last_b.data()), halves, last.data());
    std::copy_n(last.begin(), count - i, out + i);
}

/// The upper 26 bits of a number, and the others: products of either with 17 bits are exact.
struct Split {
    Lanes high, low;
};
HWY_INLINE Split split(Lanes value) {
    const Numbers numbers;
    const auto bits = hn::BitCast(numbers, value);
    const Lanes high =
        hn::BitCast(Doubles(), hn::And(bits, hn::Set(numbers, ~((std::int64_t{1} << 27) - 1))));
    return {high, hn::Sub(value, high)};
}

/// @param uncertain set where the result may be wrong
HWY_INLINE Lanes blended_double(Lanes a, Lanes b, Lanes of_a, Lanes of_b,
                                hn::Mask<Doubles>& uncertain) {
    const Doubles d;
    const Split from_a = split(a), from_b = split(b);
    // The blend times N is the sum of these four.
    const Sum high = two_sum(hn::Mul(from_a.high, of_a), hn::Mul(from_b.high, of_b));
    const Sum low = two_sum(hn::Mul(from_a.low, of_a), hn::Mul(from_b.low, of_b));
    const Sum middle = two_sum(high.error, low.sum);
    const Sum all = two_sum(high.sum, middle.sum);
    const Lanes rest = hn::Add(low.error, middle.error), zero = hn::Zero(d);
    // Where the rest is smaller than the error, it does not change the side on which the blend lies.
    const auto told = hn::Or(hn::Eq(rest, zero), hn::Lt(hn::Abs(rest), hn::Abs(all.error)));
    const Lanes most = hn::Max(hn::Abs(a), hn::Abs(b)), size = hn::Abs(all.sum);
    const auto usual = hn::And(hn::Lt(most, hn::Set(d, 0x1p1000)),
                               hn::Or(hn::Gt(size, hn::Set(d, 0x1p-900)), hn::Eq(most, zero)));
    const Lanes none = hn::Add(missing(a), missing(b));
    uncertain = hn::And(hn::Not(hn::And(told, usual)), hn::Eq(none, zero));
    const Lanes down = lowered(all.sum, hn::Lt(all.error, zero));
    return hn::Add(hn::Mul(down, hn::Set(d, 1.0 / Instant::kFractions)), none);
}

void blend_double(const double* a, const double* b, std::size_t count, std::uint32_t n,
                  double* out) {
    const Doubles d;
    const std::size_t lanes = hn::Lanes(d);
    const Lanes of_a = hn::Set(d, Instant::kFractions - n), of_b = hn::Set(d, n);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) {
        hn::Mask<Doubles> uncertain;
        hn::StoreU(blended_double(hn::LoadU(d, a + i), hn::LoadU(d, b + i), of_a, of_b, uncertain),
                   d, out + i);
        if (!hn::AllFalse(d, uncertain)) [[unlikely]]
            for (std::size_t lane = 0; lane < lanes; ++lane)
                out[i + lane] = blended(a[i + lane], b[i + lane], n);
    }
    for (; i < count; ++i)
        out[i] = blended(a[i], b[i], n);
}

/// @param lowered_by subtracted, modulo 2^32
template <class T>
void blend_whole(const T* a, const T* b, std::size_t count, std::uint32_t n,
                 std::uint32_t lowered_by, std::int32_t* out) {
    const hn::ScalableTag<std::int32_t> d;
    const hn::Rebind<T, decltype(d)> stored;
    const std::uint32_t of_a = Instant::kFractions - n;
    const auto weight_a = hn::Set(d, static_cast<std::int32_t>(of_a)),
               weight_b = hn::Set(d, static_cast<std::int32_t>(n)),
               lowered = hn::Set(d, static_cast<std::int32_t>(lowered_by));
    std::size_t i = 0;
    for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
        const auto first = hn::Mul(hn::PromoteTo(d, hn::LoadU(stored, a + i)), weight_a);
        const auto second = hn::Mul(hn::PromoteTo(d, hn::LoadU(stored, b + i)), weight_b);
        hn::StoreU(hn::Sub(hn::Add(first, second), lowered), d, out + i);
    }
    for (; i < count; ++i)
        out[i] = static_cast<std::int32_t>(of_a * static_cast<std::uint32_t>(a[i]) +
                                           n * static_cast<std::uint32_t>(b[i]) - lowered_by);
}

// Functions that are chosen at run time cannot be templates.
void blend_whole_numbers(ValueType type, const std::byte* a, const std::byte* b,
                         std::span<const Blend::Run> runs, std::uint32_t n,
                         std::uint32_t lowered_by, std::int32_t* out) {
    visit_value_type(type, [&]<class T>(std::type_identity<T>) {
        if constexpr (sizeof(T) <= 2)
            for (const Blend::Run& run : runs)
                blend_whole(reinterpret_cast<const T*>(a) + run.first,
                            reinterpret_cast<const T*>(b) + run.first, run.count, n, lowered_by,
                            out + run.first);
    });
}
void blend_sided_runs(const float* a, const float* b, std::span<const Blend::Run> runs,
                      std::uint32_t n, std::span<const Blend::Side> sides, float* out) {
    for (const Blend::Run& run : runs)
        blend_sided(a + run.first, b + run.first, run.count, n, sides, out + run.first);
}

} // namespace
} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isochron::index {
namespace {

HWY_EXPORT(blend_single);
HWY_EXPORT(blend_sided_runs);
HWY_EXPORT(blend_double);
HWY_EXPORT(blend_whole_numbers);

__extension__ using WideInteger = __int128;

/// A number as `mantissa * 2^exponent`; the mantissa has 53 bits, or is 0.
struct Parts {
    WideInteger mantissa;
    int exponent;
};
Parts parts_of(double value) {
    constexpr int kBits = std::numeric_limits<double>::digits;
    int exponent = 0;
    const double fraction = std::frexp(value, &exponent);
    return {static_cast<std::int64_t>(std::ldexp(fraction, kBits)), exponent - kBits};
}

/// Rounded down, by any number of bits.
WideInteger shifted_right(WideInteger value, int bits) {
    return value >> std::min(bits, 126);
}

int bits_of(WideInteger value) {
    int bits = 0;
    for (WideInteger rest = value < 0 ? -value : value; rest > 0; rest >>= 1)
        ++bits;
    return bits;
}

/// Greatest value that 16 bits with an exact sum in an i32 are lowered by.
constexpr std::uint32_t kHalf = std::uint32_t{1} << 31;

bool stays_whole(ValueType type, const Scaling& scaling) {
    return size_of(type) <= 2 && scaling == Scaling{};
}

} // namespace

double blended(double a, double b, std::uint32_t n) {
    if (!std::isfinite(a) || !std::isfinite(b))
        return std::numeric_limits<double>::quiet_NaN();
    Parts high = parts_of(a), low = parts_of(b);
    high.mantissa *= Instant::kFractions - n;
    low.mantissa *= n;
    if (high.mantissa == 0 || (low.mantissa != 0 && high.exponent < low.exponent))
        std::swap(high, low);
    // Both in units that the sum, which has at least 51 bits more than the upper mantissa's lowest,
    // is rounded to in any case: rounding the lower one down to them first changes nothing.
    constexpr int kMostShift = 50;
    WideInteger sum = high.mantissa;
    int exponent = high.exponent;
    if (low.mantissa != 0) {
        const int apart = high.exponent - low.exponent, shift = std::min(apart, kMostShift);
        exponent -= shift;
        sum = (sum << shift) + shifted_right(low.mantissa, apart - shift);
    }
    if (sum == 0)
        return 0;
    exponent -= std::countr_zero(Instant::kFractions);
    constexpr int kBits = std::numeric_limits<double>::digits;
    constexpr int kLowest =
        std::numeric_limits<double>::min_exponent - kBits; // exponent of subnormal numbers
    const int surplus = std::max({bits_of(sum) - kBits, kLowest - exponent, 0});
    return std::ldexp(static_cast<double>(static_cast<std::int64_t>(shifted_right(sum, surplus))),
                      exponent + surplus);
}

Blend::Blend(ValueType type, const Scaling& scaling, std::uint32_t n,
             std::span<const double> isovalues)
    : stored_(type), type_(ValueType::f64), stored_scaling_(scaling), n_(n) {
    if (isovalues.size() <= kMostIsovalues)
        for (const double isovalue : isovalues)
            if (std::isfinite(isovalue) && // else it has no cells
                std::ranges::find(this->isovalues(), isovalue) == this->isovalues().end())
                isovalues_[count_++] = isovalue;
    if (type == ValueType::f32 && scaling == Scaling{} && count_ > 0)
        stay_single();
    if (!stays_whole(type, scaling))
        return;
    type_ = ValueType::i32;
    scaling_ = {1.0 / Instant::kFractions,
                type == ValueType::u16 ? static_cast<double>(kHalf / Instant::kFractions) : 0.0};
}

/// Blends become f32 if f32 can tell the isovalues apart.
void Blend::stay_single() {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr double kMost = std::numeric_limits<float>::max();
    for (std::size_t i = 0; i < count_; ++i) {
        const double isovalue = isovalues_[i];
        float above = isovalue > kMost ? kInfinity : static_cast<float>(std::max(isovalue, -kMost));
        if (static_cast<double>(above) < isovalue)
            above = std::nextafter(above, kInfinity);
        const auto before = std::span(sides_).first(i);
        if (std::ranges::find(before, static_cast<double>(above), &Side::above) != before.end())
            return;
        sides_[i] = {isovalue, above, std::nextafter(above, -kInfinity)};
    }
    type_ = ValueType::f32;
}

void Blend::operator()(std::span<const std::byte> a, std::span<const std::byte> b,
                       std::byte* out) const {
    const Run all{0, a.size() / size_of(stored_)};
    (*this)(a.data(), b.data(), {&all, 1}, out);
}

void Blend::operator()(const std::byte* a, const std::byte* b, std::span<const Run> runs,
                       std::byte* out) const {
    if (type_ == ValueType::i32) {
        HWY_DYNAMIC_DISPATCH(blend_whole_numbers)
        (stored_, a, b, runs, n_, stored_ == ValueType::u16 ? kHalf : 0,
         reinterpret_cast<std::int32_t*>(out));
        return;
    }
    if (type_ == ValueType::f32) {
        HWY_DYNAMIC_DISPATCH(blend_sided_runs)
        (reinterpret_cast<const float*>(a), reinterpret_cast<const float*>(b), runs, n_,
         std::span(sides_).first(count_), reinterpret_cast<float*>(out));
        return;
    }
    for (const Run& run : runs)
        blend_doubles(a + run.first * size_of(stored_), b + run.first * size_of(stored_), run.count,
                      reinterpret_cast<double*>(out) + run.first);
}

void Blend::blend_doubles(const std::byte* a, const std::byte* b, std::size_t count,
                          double* to) const {
    if (stored_ == ValueType::f32 && stored_scaling_ == Scaling{}) {
        HWY_DYNAMIC_DISPATCH(blend_single)
        (reinterpret_cast<const float*>(a), reinterpret_cast<const float*>(b), count, n_, to);
        return;
    }
    constexpr std::size_t kTogether = 512;
    std::array<double, kTogether> scaled_a, scaled_b;
    visit_value_type(stored_, [&]<class T>(std::type_identity<T>) {
        const auto* from_a = reinterpret_cast<const T*>(a);
        const auto* from_b = reinterpret_cast<const T*>(b);
        for (std::size_t first = 0; first < count; first += kTogether) {
            const std::size_t some = std::min(kTogether, count - first);
            for (std::size_t i = 0; i < some; ++i) {
                scaled_a[i] = stored_scaling_(static_cast<double>(from_a[first + i]));
                scaled_b[i] = stored_scaling_(static_cast<double>(from_b[first + i]));
            }
            HWY_DYNAMIC_DISPATCH(blend_double)
            (scaled_a.data(), scaled_b.data(), some, n_, to + first);
        }
    });
}

} // namespace isochron::index
#endif
