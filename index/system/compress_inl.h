// Masks as bits, and the lanes that a mask chooses, in order; compiled once for each SIMD target.
#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>

// Highway's guard: the file is read again for every target.
#if defined(ISOCHRON_INDEX_COMPRESS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ISOCHRON_INDEX_COMPRESS_INL_H
#undef ISOCHRON_INDEX_COMPRESS_INL_H
#else
#define ISOCHRON_INDEX_COMPRESS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A mask as bits, one for every lane, at most 64.
template <class D, class Mask>
HWY_INLINE std::uint64_t bits_of(D d, Mask mask) {
    std::uint64_t bits = 0;
    hn::StoreMaskBits(d, mask, reinterpret_cast<std::uint8_t*>(&bits));
    return bits;
}

#if HWY_TARGET == HWY_AVX2

// Highway's own Compress has its tables in local variables, which g++ 12 copies to the stack in each
// call. For eight lanes that is 1 KiB, and finding ids took four times as long.

/// For each set of eight lanes, as bits: the numbers of its lanes in order, four bits each.
constexpr std::array<std::uint32_t, 256> kChosenOfEight = [] {
    std::array<std::uint32_t, 256> chosen{};
    for (std::uint32_t bits = 0; bits < 256; ++bits)
        for (std::uint32_t lane = 0, to = 0; lane < 8; ++lane)
            if (bits >> lane & 1)
                chosen[bits] |= lane << 4 * to++;
    return chosen;
}();

/// Shuffles for lanes of 16 bits, as numbers of bytes.
constexpr std::array<std::array<std::uint8_t, 16>, 256> kBytesOfEight = [] {
    std::array<std::array<std::uint8_t, 16>, 256> chosen{};
    for (std::size_t bits = 0; bits < 256; ++bits)
        for (std::size_t i = 0; i < 16; ++i)
            chosen[bits][i] =
                static_cast<std::uint8_t>((kChosenOfEight[bits] >> i / 2 * 4 & 7) * 2 + i % 2);
    return chosen;
}();

#endif

/// @param bits of the chosen lanes, of 32 bits each @return these lanes in order, and any after them
template <class D>
HWY_INLINE hn::Vec<D> compress(D d, hn::Vec<D> lanes, std::uint64_t bits) {
#if HWY_TARGET == HWY_AVX2
    static_assert(hn::MaxLanes(d) == 8 && sizeof(hn::TFromD<D>) == 4);
    const hn::RebindToUnsigned<D> words;
    const auto packed = hn::Set(words, kChosenOfEight[bits]);
    const auto shift = hn::ShiftLeft<2>(hn::Iota(words, 0));
    const auto number = hn::And(hn::Shr(packed, shift), hn::Set(words, 7));
    return hn::TableLookupLanes(lanes, hn::IndicesFromVec(d, number));
#else
    // LoadMaskBits reads eight bytes.
    return hn::Compress(lanes, hn::LoadMaskBits(d, reinterpret_cast<const std::uint8_t*>(&bits)));
#endif
}

template <class D>
HWY_INLINE hn::Vec<D> compress(D d, hn::Vec<D> lanes, hn::Mask<D> chosen) {
#if HWY_TARGET == HWY_AVX2
    return compress(d, lanes, bits_of(d, chosen));
#else
    (void)d;
    return hn::Compress(lanes, chosen);
#endif
}

/// Stores the chosen lanes, of 16 bits each, in order, and any after them up to a vector.
/// @return how many were chosen
template <class D>
HWY_INLINE std::size_t store_chosen(D d, hn::Vec<D> lanes, hn::Mask<D> chosen, std::uint16_t* to) {
#if HWY_TARGET == HWY_AVX2
    static_assert(hn::MaxLanes(d) == 16 && sizeof(hn::TFromD<D>) == 2);
    const std::uint64_t bits = bits_of(d, chosen);
    const hn::Half<D> half;
    const hn::Repartition<std::uint8_t, hn::Half<D>> bytes;
    const auto store = [&](hn::Vec<hn::Half<D>> eight, std::uint64_t of_eight, std::uint16_t* at)
                           HWY_ATTR {
                               const auto& order = kBytesOfEight[of_eight];
                               const auto from = hn::BitCast(half, hn::LoadU(bytes, order.data()));
                               hn::StoreU(hn::TableLookupBytes(eight, from), half, at);
                           };
    store(hn::LowerHalf(half, lanes), bits & 255, to);
    store(hn::UpperHalf(half, lanes), bits >> 8, to + hwy::PopCount(bits & 255));
    return hwy::PopCount(bits);
#else
    return hn::CompressStore(lanes, chosen, d, to);
#endif
}

} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
