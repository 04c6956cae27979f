// Running sums along an axis, with fast paths for rows of whole chunks.
#include "index/file/chunks/chunk_sums.h"

#include "index/file/chunks/chunk_grid.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "index/file/chunks/chunk_sums.cpp"
#include <hwy/foreach_target.h> // must come before highway.h

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Size = std::array<std::uint32_t, 3>;

#if HWY_TARGET != HWY_SCALAR
/// Running sums within each block of 16 bytes.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V sums_of_blocks(D d, V values) {
    constexpr std::size_t kLanes = 16 / sizeof(hn::TFromD<D>);
    V sum = hn::Add(values, hn::ShiftLeftLanes<1>(d, values));
    if constexpr (kLanes > 2)
        sum = hn::Add(sum, hn::ShiftLeftLanes<2>(d, sum));
    if constexpr (kLanes > 4)
        sum = hn::Add(sum, hn::ShiftLeftLanes<4>(d, sum));
    if constexpr (kLanes > 8)
        sum = hn::Add(sum, hn::ShiftLeftLanes<8>(d, sum));
    return sum;
}

/// Running sums along rows of `kChunkEdge` values.
template <class T>
void sum_whole_rows(T* values, std::size_t count) {
    if constexpr (sizeof(T) == 1) { // rows of 16 bytes, several in parallel
        const hn::ScalableTag<T> wide;
        std::size_t at = 0;
        for (; at + hn::Lanes(wide) <= count; at += hn::Lanes(wide))
            hn::StoreU(sums_of_blocks(wide, hn::LoadU(wide, values + at)), wide, values + at);
        values += at;
        count -= at;
    }
    const hn::CappedTag<T, 16 / sizeof(T)> d;
    constexpr std::size_t kLanes = hn::MaxLanes(d);
    static_assert(kChunkEdge % kLanes == 0);
    for (std::size_t first = 0; first < count; first += kChunkEdge) {
        auto before = hn::Zero(d); // the sum up to here
        for (std::size_t i = first; i < first + kChunkEdge; i += kLanes) {
            auto sum = sums_of_blocks(d, hn::LoadU(d, values + i));
            sum = hn::Add(sum, before);
            hn::StoreU(sum, d, values + i);
            if constexpr (kLanes < kChunkEdge)
                before = hn::Set(d, values[i + kLanes - 1]);
        }
    }
}
#endif

template <class T>
void sum_rows(T* values, std::size_t row, std::size_t count) {
#if HWY_TARGET != HWY_SCALAR
    if (row == kChunkEdge)
        return sum_whole_rows(values, count);
#endif
    for (std::size_t first = 0; first < count; first += row) {
        T sum = 0;
        for (std::size_t i = first; i < first + row; ++i)
            values[i] = sum = static_cast<T>(sum + values[i]);
    }
}

/// Adds to each of `count` values the value `back` before it, `width` values at a time, which do
/// not depend on each other.
template <class T>
void sum_back(T* values, std::size_t count, std::size_t back, std::size_t width) {
    for (std::size_t at = back; at < count; at += width)
        for (std::size_t i = 0; i < width; ++i)
            values[at + i] = static_cast<T>(values[at + i] + values[at + i - back]);
}

/// Running sums along y and z for rows of `kChunkEdge` values, in one pass: the sum along y stays
/// in a register.
template <class T>
void sum_whole_planes(T* values, std::size_t plane, std::size_t count, bool along_y, bool along_z) {
    const hn::CappedTag<T, kChunkEdge> d;
    for (std::size_t x = 0; x < kChunkEdge; x += hn::Lanes(d))
        for (std::size_t first = 0; first < count; first += plane) {
            auto above = hn::Zero(d);
            for (std::size_t at = first + x; at < first + plane; at += kChunkEdge) {
                auto sum = hn::LoadU(d, values + at);
                if (along_y)
                    above = sum = hn::Add(above, sum);
                if (along_z && first > 0)
                    sum = hn::Add(sum, hn::LoadU(d, values + at - plane));
                hn::StoreU(sum, d, values + at);
            }
        }
}

template <class T>
void sum_along(T* values, const Size& size, const std::array<bool, 3>& axes) {
    const std::size_t row = size[0], plane = row * size[1], count = plane * size[2];
    if (axes[0])
        sum_rows(values, row, count);
    if (row == kChunkEdge)
        return sum_whole_planes(values, plane, count, axes[1], axes[2]);
    for (std::size_t first = 0; axes[1] && first < count; first += plane)
        sum_back(values + first, plane, row, row);
    if (axes[2])
        sum_back(values, count, plane, plane);
}

/// Joins the bytes of values. The compiler turns this into moves of whole vectors.
/// @param kFolded the values are folded differences
template <class T, bool kFolded>
void join_bytes(const std::byte* bytes, std::size_t count, std::byte* out) {
    auto* const words = reinterpret_cast<T*>(out);
    for (std::size_t i = 0; i < count; ++i) {
        T word = 0;
        for (std::size_t byte = 0; byte < sizeof(T); ++byte)
            word |= static_cast<T>(static_cast<T>(bytes[byte * count + i]) << 8 * byte);
        if constexpr (kFolded)
            word = static_cast<T>((word >> 1) ^ static_cast<T>(T{0} - (word & 1)));
        words[i] = word;
    }
}

template <class T>
void shift_words(std::byte* values, std::size_t count, unsigned bits) {
    auto* const words = reinterpret_cast<T*>(values);
    for (std::size_t i = 0; i < count; ++i)
        words[i] = static_cast<T>(words[i] << bits);
}

void sum_values(std::size_t bytes, const Size& size, const std::array<bool, 3>& axes,
                std::byte* values) {
    switch (bytes) {
    case 1: return sum_along(reinterpret_cast<std::uint8_t*>(values), size, axes);
    case 2: return sum_along(reinterpret_cast<std::uint16_t*>(values), size, axes);
    case 4: return sum_along(reinterpret_cast<std::uint32_t*>(values), size, axes);
    default: return sum_along(reinterpret_cast<std::uint64_t*>(values), size, axes);
    }
}

template <bool kFolded>
void join_values_of(std::size_t bytes, const std::byte* shuffled, std::size_t count,
                    std::byte* out) {
    switch (bytes) {
    case 1: std::copy_n(shuffled, count, out); return;
    case 2: return join_bytes<std::uint16_t, kFolded>(shuffled, count, out);
    case 4: return join_bytes<std::uint32_t, kFolded>(shuffled, count, out);
    default: return join_bytes<std::uint64_t, kFolded>(shuffled, count, out);
    }
}

void join_values(std::size_t bytes, bool folded, const std::byte* shuffled, std::size_t count,
                 std::byte* out) {
    return folded ? join_values_of<true>(bytes, shuffled, count, out)
                  : join_values_of<false>(bytes, shuffled, count, out);
}

void shift_values(std::size_t bytes, std::byte* values, std::size_t count, unsigned bits) {
    switch (bytes) {
    case 1: return shift_words<std::uint8_t>(values, count, bits);
    case 2: return shift_words<std::uint16_t>(values, count, bits);
    case 4: return shift_words<std::uint32_t>(values, count, bits);
    default: return shift_words<std::uint64_t>(values, count, bits);
    }
}

} // namespace
} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isochron::index {

HWY_EXPORT(sum_values);
HWY_EXPORT(join_values);
HWY_EXPORT(shift_values);

void from_differences(ValueType type, const std::array<std::uint32_t, 3>& size,
                      const std::array<bool, 3>& axes, std::span<std::byte> values) {
    HWY_DYNAMIC_DISPATCH(sum_values)(size_of(type), size, axes, values.data());
}

void unshuffle(std::span<const std::byte> shuffled, std::size_t size, std::byte* out) {
    HWY_DYNAMIC_DISPATCH(join_values)(size, false, shuffled.data(), shuffled.size() / size, out);
}

void unshuffle_folded(std::span<const std::byte> shuffled, std::size_t size, std::byte* out) {
    HWY_DYNAMIC_DISPATCH(join_values)(size, true, shuffled.data(), shuffled.size() / size, out);
}

void shift_up(std::span<std::byte> values, std::size_t size, unsigned bits) {
    HWY_DYNAMIC_DISPATCH(shift_values)(size, values.data(), values.size() / size, bits);
}

} // namespace isochron::index
#endif
