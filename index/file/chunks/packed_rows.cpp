// Turns 16 numbers at a time into bit planes and back; compiled once for each SIMD target.
#include "index/file/chunks/packed_rows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "index/file/chunks/packed_rows.cpp"
#include <hwy/foreach_target.h> // must come before highway.h

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kRow = 16; ///< numbers in a row, which has its own number of bits
constexpr unsigned kMostBits = 8;

unsigned width_of(const std::byte* widths, std::size_t row) {
    return std::to_integer<unsigned>(widths[row / 2]) >> row % 2 * 4 & 15;
}

#if HWY_TARGET == HWY_SCALAR
std::uint8_t folded(std::uint8_t number) {
    return static_cast<std::uint8_t>(number << 1 ^ (number & 0x80 ? 0xff : 0));
}
std::uint8_t unfolded(std::uint8_t number) {
    return static_cast<std::uint8_t>(number >> 1 ^ (number & 1 ? 0xff : 0));
}

/// @param planes set to the bit planes @return number of bits, and planes, of the largest number
template <bool kFold>
unsigned planes_of(const std::uint8_t* numbers, std::array<std::uint16_t, kMostBits>& planes) {
    planes = {};
    unsigned all = 0;
    for (std::size_t i = 0; i < kRow; ++i) {
        const std::uint8_t number = kFold ? folded(numbers[i]) : numbers[i];
        all |= number;
        for (unsigned bit = 0; bit < kMostBits; ++bit)
            planes[bit] = static_cast<std::uint16_t>(planes[bit] | (number >> bit & 1) << i);
    }
    return static_cast<unsigned>(std::bit_width(all));
}

template <bool kFold>
void numbers_of(const std::byte* planes, unsigned bits, std::uint8_t* out) {
    std::array<std::uint8_t, kRow> numbers{};
    for (unsigned bit = 0; bit < bits; ++bit)
        for (std::size_t i = 0; i < kRow; ++i)
            numbers[i] |= static_cast<std::uint8_t>(
                (std::to_integer<unsigned>(planes[2 * bit + i / 8]) >> i % 8 & 1) << bit);
    std::ranges::transform(numbers, out, [](std::uint8_t n) { return kFold ? unfolded(n) : n; });
}
#else
template <bool kFold>
unsigned planes_of(const std::uint8_t* numbers, std::array<std::uint16_t, kMostBits>& planes) {
    const hn::CappedTag<std::uint8_t, kRow> d;
    const hn::RebindToSigned<decltype(d)> s;
    auto fold = hn::LoadU(d, numbers);
    if constexpr (kFold) {
        const auto sign = hn::BitCast(d, hn::BroadcastSignBit(hn::BitCast(s, fold)));
        fold = hn::Xor(hn::Add(fold, fold), sign);
    }
    unsigned used = 0;
    for (unsigned bit = 0; bit < kMostBits; ++bit) {
        const auto set = hn::TestBit(fold, hn::Set(d, static_cast<std::uint8_t>(1u << bit)));
        std::array<std::uint8_t, 8> stored{};
        hn::StoreMaskBits(d, set, stored.data());
        std::memcpy(&planes[bit], stored.data(), sizeof planes[bit]);
        used |= (planes[bit] != 0 ? 1u : 0u) << bit;
    }
    return static_cast<unsigned>(std::bit_width(used));
}

/// Vectors so long that a quarter of one holds a whole number of rows.
using Rows = hn::CappedTag<std::uint8_t, HWY_HAVE_SCALABLE ? kRow : 4 * kRow>;

/// By number of bits: all ones in the bytes of a row's planes, zeros in what follows them.
alignas(kRow) constexpr auto kOwnPlanes = [] {
    std::array<std::array<std::uint8_t, kRow>, kMostBits + 1> own{};
    for (std::size_t bits = 0; bits < own.size(); ++bits)
        std::fill_n(own[bits].begin(), 2 * bits, std::uint8_t{0xff});
    return own;
}();

/// The planes of as many rows as a vector holds. Reads the bytes of eight planes for each row, even
/// if some belong to the next row: a test at each row costs more.
/// @param at of the planes of `row`; moves behind the planes of the last row
template <class D>
HWY_INLINE hn::Vec<D> planes_of_rows(D d, const std::byte* widths, std::size_t row,
                                     const std::byte*& at) {
    if constexpr (hn::MaxLanes(d) == kRow) {
        const unsigned bits = width_of(widths, row);
        const auto planes = hn::And(hn::LoadU(d, reinterpret_cast<const std::uint8_t*>(at)),
                                    hn::Load(d, kOwnPlanes[bits].data()));
        at += 2 * bits;
        return planes;
    } else {
        const hn::Half<D> half;
        const auto low = planes_of_rows(half, widths, row, at);
        return hn::Combine(d, planes_of_rows(half, widths, row + hn::MaxLanes(half) / kRow, at),
                           low);
    }
}

/// Exchanges the bits of `mask` with the bits that are `kBack` higher.
template <int kBack, class D>
HWY_INLINE hn::Vec<D> exchange(D d, hn::Vec<D> words, std::uint64_t mask) {
    const auto changed = hn::And(hn::Xor(words, hn::ShiftRight<kBack>(words)), hn::Set(d, mask));
    return hn::Xor(words, hn::Xor(changed, hn::ShiftLeft<kBack>(changed)));
}

/// Numbers from the planes of rows.
template <bool kFold, class D>
HWY_INLINE hn::Vec<D> numbers_of_planes(D d, hn::Vec<D> planes) {
    // The bytes of the first eight numbers, then of the other eight: two squares of 8 x 8 bits.
    alignas(kRow) static constexpr std::array<std::uint8_t, kRow> kHalves{
        0, 2, 4, 6, 8, 10, 12, 14, 1, 3, 5, 7, 9, 11, 13, 15};
    const hn::Repartition<std::uint64_t, D> squares;
    auto bits =
        hn::BitCast(squares, hn::TableLookupBytes(planes, hn::LoadDup128(d, kHalves.data())));
    // Rows and columns of each square change places: single bits, then 2 x 2 and 4 x 4 of them.
    bits = exchange<7>(squares, bits, 0x00aa00aa00aa00aa);
    bits = exchange<14>(squares, bits, 0x0000cccc0000cccc);
    bits = exchange<28>(squares, bits, 0x00000000f0f0f0f0);
    const auto fold = hn::BitCast(d, bits);
    if constexpr (!kFold)
        return fold;
    const auto sign = hn::Sub(hn::Zero(d), hn::And(fold, hn::Set(d, std::uint8_t{1})));
    // Bytes have no shift of their own: the bit that comes in from above is masked away.
    const hn::Repartition<std::uint16_t, D> wide;
    const auto half = hn::And(hn::BitCast(d, hn::ShiftRight<1>(hn::BitCast(wide, fold))),
                              hn::Set(d, std::uint8_t{0x7f}));
    return hn::Xor(half, sign);
}

template <bool kFold>
void numbers_of(const std::byte* planes, unsigned bits, std::uint8_t* out) {
    const hn::CappedTag<std::uint8_t, kRow> d;
    alignas(kRow) std::array<std::uint8_t, kRow> own{};
    std::memcpy(own.data(), planes, 2 * bits);
    hn::StoreU(numbers_of_planes<kFold>(d, hn::Load(d, own.data())), d, out);
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
        const unsigned bits = planes_of<true>(from, planes);
        widths[row / 2] |= static_cast<std::byte>(bits << row % 2 * 4);
        std::memcpy(at, planes.data(), sizeof planes); // the next row goes over what is unused
        at += bits * sizeof(std::uint16_t);
    }
    out.resize(static_cast<std::size_t>(at - out.data()));
}

/// Whether each of so many rows has a width that there is, and all of them take `planes` bytes.
bool are_widths(const std::byte* widths, std::size_t rows, std::size_t planes) {
    std::size_t bits = 0;
    bool fit = true;
    for (std::size_t i = 0; i < (rows + 1) / 2; ++i) {
        const auto both = std::to_integer<std::uint8_t>(widths[i]);
        const std::uint8_t low = both & 15, high = both >> 4;
        fit &= low <= kMostBits && high <= kMostBits;
        bits += low + high;
    }
    return fit && planes == 2 * bits && (rows % 2 == 0 || width_of(widths, rows) == 0);
}

bool unpack(const std::byte* packed, std::size_t size, std::uint8_t* out, std::size_t count) {
    const std::size_t rows = (count + kRow - 1) / kRow, widths = (rows + 1) / 2;
    if (size < widths || !are_widths(packed, rows, size - widths))
        return false;
    const std::byte* at = packed + widths;
    std::size_t row = 0;
#if HWY_TARGET != HWY_SCALAR
    const Rows d;
    const std::size_t lanes = hn::Lanes(d), whole = count / kRow;
    const std::byte* const end = packed + size;
    for (; row + lanes / kRow <= whole && static_cast<std::size_t>(end - at) >= lanes;
         row += lanes / kRow)
        hn::StoreU(numbers_of_planes<true>(d, planes_of_rows(d, packed, row, at)), d,
                   out + row * kRow);
#endif
    for (; row < rows; ++row) {
        const unsigned bits = width_of(packed, row);
        std::array<std::uint8_t, kRow> numbers;
        numbers_of<true>(at, bits, numbers.data());
        std::copy_n(numbers.begin(), std::min(kRow, count - row * kRow), out + row * kRow);
        at += 2 * bits;
    }
    return true;
}

/// Whether all numbers of a row are zero.
bool is_zero(const std::uint8_t* row) {
    std::array<std::uint64_t, kRow / 8> halves;
    std::memcpy(halves.data(), row, kRow);
    return (halves[0] | halves[1]) == 0;
}

void pack_words(const std::uint8_t* bytes, std::size_t word, std::size_t count,
                std::vector<std::byte>& out) {
    const std::size_t rows = (count + kRow - 1) / kRow, first = out.size();
    out.resize(first + rows * (1 + word * kRow) + kRow);
    std::byte* const widths = out.data() + first;
    std::byte* at = widths + rows;
    std::array<std::array<std::uint8_t, kRow>, sizeof(std::uint64_t)> last{};
    std::array<const std::uint8_t*, sizeof(std::uint64_t)> of{};
    for (std::size_t row = 0; row < rows; ++row) {
        const std::size_t there = std::min(kRow, count - row * kRow);
        for (std::size_t byte = 0; byte < word; ++byte) {
            of[byte] = bytes + byte * count + row * kRow;
            if (there < kRow) {
                std::copy_n(of[byte], there, last[byte].begin());
                of[byte] = last[byte].data();
            }
        }
        std::size_t highest = word;
        while (highest > 0 && is_zero(of[highest - 1]))
            --highest;
        std::array<std::uint16_t, kMostBits> planes{};
        const unsigned bits = highest > 0 ? planes_of<false>(of[highest - 1], planes) : 0;
        // A byte with all its bits is stored as it is.
        const std::size_t whole = bits == kMostBits || highest == 0 ? highest : highest - 1;
        for (std::size_t byte = 0; byte < whole; ++byte, at += kRow)
            std::memcpy(at, of[byte], kRow);
        const std::size_t rest = whole < highest ? bits : 0;
        std::memcpy(at, planes.data(), sizeof planes); // as above
        at += rest * sizeof(std::uint16_t);
        widths[row] = static_cast<std::byte>(whole * kMostBits + rest);
    }
    out.resize(static_cast<std::size_t>(at - out.data()));
}

bool unpack_words(const std::byte* packed, std::size_t size, std::size_t word, std::uint8_t* out,
                  std::size_t count) {
    const std::size_t rows = (count + kRow - 1) / kRow;
    if (size < rows)
        return false;
    std::size_t sum = 0;
    bool fit = true;
    for (std::size_t row = 0; row < rows; ++row) {
        const auto width = std::to_integer<std::size_t>(packed[row]);
        fit &= width <= word * kMostBits;
        sum += width;
    }
    if (!fit || size - rows != 2 * sum)
        return false;
    const std::byte* at = packed + rows;
    std::array<std::uint8_t, kRow> numbers;
    for (std::size_t row = 0; row < rows; ++row) {
        const auto width = std::to_integer<unsigned>(packed[row]);
        const std::size_t whole = width / kMostBits;
        const unsigned rest = width % kMostBits;
        const std::size_t there = std::min(kRow, count - row * kRow);
        std::uint8_t* to = out + row * kRow;
        const auto put = [&](const std::uint8_t* from) {
            if (there == kRow)
                std::memcpy(to, from, kRow);
            else
                std::copy_n(from, there, to);
            to += count;
        };
        for (std::size_t byte = 0; byte < whole; ++byte, at += kRow)
            put(reinterpret_cast<const std::uint8_t*>(at));
        if (rest > 0) {
            numbers_of<false>(at, rest, numbers.data());
            at += 2 * rest;
            put(numbers.data());
        }
        numbers = {};
        for (std::size_t byte = whole + (rest > 0); byte < word; ++byte)
            put(numbers.data());
    }
    return true;
}

} // namespace
} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isochron::index {

HWY_EXPORT(pack);
HWY_EXPORT(unpack);
HWY_EXPORT(pack_words);
HWY_EXPORT(unpack_words);

void pack_rows(std::span<const std::byte> numbers, std::vector<std::byte>& out) {
    HWY_DYNAMIC_DISPATCH(pack)
    (reinterpret_cast<const std::uint8_t*>(numbers.data()), numbers.size(), out);
}

bool unpack_rows(std::span<const std::byte> packed, std::span<std::byte> out) {
    return HWY_DYNAMIC_DISPATCH(unpack)(packed.data(), packed.size(),
                                        reinterpret_cast<std::uint8_t*>(out.data()), out.size());
}

void pack_word_rows(std::span<const std::byte> numbers, std::size_t word,
                    std::vector<std::byte>& out) {
    HWY_DYNAMIC_DISPATCH(pack_words)
    (reinterpret_cast<const std::uint8_t*>(numbers.data()), word, numbers.size() / word, out);
}

bool unpack_word_rows(std::span<const std::byte> packed, std::size_t word,
                      std::span<std::byte> out) {
    return HWY_DYNAMIC_DISPATCH(unpack_words)(packed.data(), packed.size(), word,
                                              reinterpret_cast<std::uint8_t*>(out.data()),
                                              out.size() / word);
}

} // namespace isochron::index
#endif
