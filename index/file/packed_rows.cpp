// Turns 16 numbers at a time into bit planes and back; compiled once for each SIMD target.
#include "index/file/packed_rows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "index/file/packed_rows.cpp"
#include <hwy/foreach_target.h> // must come before highway.h

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kRow = 16; ///< numbers in a row, which has its own number of bits
constexpr unsigned kMostBits = 8;

#if HWY_TARGET == HWY_SCALAR
std::uint8_t folded(std::uint8_t number) {
    return static_cast<std::uint8_t>(number << 1 ^ (number & 0x80 ? 0xff : 0));
}
std::uint8_t unfolded(std::uint8_t number) {
    return static_cast<std::uint8_t>(number >> 1 ^ (number & 1 ? 0xff : 0));
}

/// @param planes set to the bit planes @return number of bits, and planes, of the largest number
unsigned planes_of(const std::uint8_t* numbers, std::array<std::uint16_t, kMostBits>& planes) {
    planes = {};
    unsigned all = 0;
    for (std::size_t i = 0; i < kRow; ++i) {
        const std::uint8_t number = folded(numbers[i]);
        all |= number;
        for (unsigned bit = 0; bit < kMostBits; ++bit)
            planes[bit] = static_cast<std::uint16_t>(planes[bit] | (number >> bit & 1) << i);
    }
    return static_cast<unsigned>(std::bit_width(all));
}

void numbers_of(const std::byte* planes, unsigned bits, std::uint8_t* out) {
    std::array<std::uint8_t, kRow> numbers{};
    for (unsigned bit = 0; bit < bits; ++bit)
        for (std::size_t i = 0; i < kRow; ++i)
            numbers[i] |= static_cast<std::uint8_t>(
                (std::to_integer<unsigned>(planes[2 * bit + i / 8]) >> i % 8 & 1) << bit);
    std::ranges::transform(numbers, out, unfolded);
}
void whole_numbers_of(const std::byte* planes, unsigned bits, std::uint8_t* out) {
    numbers_of(planes, bits, out);
}
#else
unsigned planes_of(const std::uint8_t* numbers, std::array<std::uint16_t, kMostBits>& planes) {
    const hn::CappedTag<std::uint8_t, kRow> d;
    const hn::RebindToSigned<decltype(d)> s;
    const auto number = hn::LoadU(d, numbers);
    const auto sign = hn::BitCast(d, hn::BroadcastSignBit(hn::BitCast(s, number)));
    const auto fold = hn::Xor(hn::Add(number, number), sign);
    unsigned bits = 0;
    for (unsigned bit = 0; bit < kMostBits; ++bit) {
        const auto set = hn::TestBit(fold, hn::Set(d, static_cast<std::uint8_t>(1u << bit)));
        std::array<std::uint8_t, 8> stored{};
        hn::StoreMaskBits(d, set, stored.data());
        std::memcpy(&planes[bit], stored.data(), sizeof planes[bit]);
        if (planes[bit])
            bits = bit + 1;
    }
    return bits;
}

/// @param planes must have 16 readable bytes, the size of eight planes
HWY_INLINE void whole_numbers_of(const std::byte* planes, unsigned bits, std::uint8_t* out) {
    const hn::CappedTag<std::uint8_t, kRow> d;
    auto fold = hn::Zero(d);
    // Reads eight planes, even those of the next row: testing at each costs more.
    for (unsigned bit = 0; bit < kMostBits; ++bit) {
        std::array<std::uint8_t, 8> stored; // LoadMaskBits reads eight bytes
        std::uint64_t plane = 0;
        std::memcpy(&plane, planes + 2 * bit, 2);
        std::memcpy(stored.data(), &plane, sizeof plane);
        const auto set = hn::LoadMaskBits(d, stored.data());
        fold =
            hn::Or(fold, hn::IfThenElseZero(set, hn::Set(d, static_cast<std::uint8_t>(1u << bit))));
    }
    fold = hn::And(fold, hn::Set(d, static_cast<std::uint8_t>((1u << bits) - 1)));
    const auto sign = hn::Sub(hn::Zero(d), hn::And(fold, hn::Set(d, std::uint8_t{1})));
    // Bytes have no shift of their own: the bit that comes in from above is masked away.
    const hn::Repartition<std::uint16_t, decltype(d)> wide;
    const auto half = hn::And(hn::BitCast(d, hn::ShiftRight<1>(hn::BitCast(wide, fold))),
                              hn::Set(d, std::uint8_t{0x7f}));
    hn::StoreU(hn::Xor(half, sign), d, out);
}

/// The same at the end of the bytes, where eight planes cannot be read.
void numbers_of(const std::byte* planes, unsigned bits, std::uint8_t* out) {
    std::array<std::byte, 2 * kMostBits> copy{};
    std::copy_n(planes, 2 * bits, copy.begin());
    whole_numbers_of(copy.data(), bits, out);
}
#endif

void pack(const std::uint8_t* numbers, std::size_t count, std::vector<std::byte>& out) {
    const std::size_t rows = (count + kRow - 1) / kRow, first = out.size();
    out.resize(first + (rows + 1) / 2 + count / kRow * kRow + kRow, std::byte{0});
    std::byte* const widths = out.data() + first;
    std::byte* at = widths + (rows + 1) / 2;
    for (std::size_t row = 0; row < rows; ++row) {
        std::array<std::uint8_t, kRow> last{};
        const std::uint8_t* from = numbers + row * kRow;
        if (count - row * kRow < kRow) {
            std::copy_n(from, count - row * kRow, last.begin());
            from = last.data();
        }
        std::array<std::uint16_t, kMostBits> planes;
        const unsigned bits = planes_of(from, planes);
        widths[row / 2] |= static_cast<std::byte>(bits << row % 2 * 4);
        std::memcpy(at, planes.data(), bits * sizeof(std::uint16_t));
        at += bits * sizeof(std::uint16_t);
    }
    out.resize(static_cast<std::size_t>(at - out.data()));
}

bool unpack(const std::byte* packed, std::size_t size, std::uint8_t* out, std::size_t count) {
    const std::size_t rows = (count + kRow - 1) / kRow, widths = (rows + 1) / 2;
    if (size < widths)
        return false;
    const std::byte* at = packed + widths;
    const std::byte* const end = packed + size;
    for (std::size_t row = 0; row < rows; ++row) {
        const unsigned bits = std::to_integer<unsigned>(packed[row / 2]) >> row % 2 * 4 & 15;
        const auto there = static_cast<std::size_t>(end - at);
        if (bits > kMostBits || there < 2 * bits)
            return false;
        if (const std::size_t left = count - row * kRow; left >= kRow && there >= 2 * kMostBits) {
            whole_numbers_of(at, bits, out + row * kRow);
        } else if (left < kRow) {
            std::array<std::uint8_t, kRow> last;
            numbers_of(at, bits, last.data());
            std::copy_n(last.begin(), left, out + row * kRow);
        } else {
            numbers_of(at, bits, out + row * kRow);
        }
        at += 2 * bits;
    }
    const bool rest = rows % 2 && std::to_integer<unsigned>(packed[rows / 2]) >> 4;
    return at == end && !rest;
}

} // namespace
} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isochron::index {

HWY_EXPORT(pack);
HWY_EXPORT(unpack);

void pack_rows(std::span<const std::byte> numbers, std::vector<std::byte>& out) {
    HWY_DYNAMIC_DISPATCH(pack)
    (reinterpret_cast<const std::uint8_t*>(numbers.data()), numbers.size(), out);
}

bool unpack_rows(std::span<const std::byte> packed, std::span<std::byte> out) {
    return HWY_DYNAMIC_DISPATCH(unpack)(packed.data(), packed.size(),
                                        reinterpret_cast<std::uint8_t*>(out.data()), out.size());
}

} // namespace isochron::index
#endif
