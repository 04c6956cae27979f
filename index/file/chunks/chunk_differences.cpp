// Takes differences of neighbors in a chunk, in plain loops over all values.
#include "index/file/chunks/chunk_differences.h"

#include <algorithm>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "index/file/chunks/chunk_differences.cpp"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace isochron::index::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Replaces values by differences to the value `step` before; the first `step` values of each block
/// stay.
template <class T>
void take_differences(const T* HWY_RESTRICT values, std::size_t count, std::size_t block,
                      std::size_t step, T* HWY_RESTRICT out) {
    for (std::size_t i = step; i < count; ++i)
        out[i] = static_cast<T>(values[i] - values[i - step]);
    for (std::size_t first = 0; first < count; first += block)
        for (std::size_t i = first; i < first + step; ++i)
            out[i] = values[i];
}

/// Estimates the bits that the differences take. For bytes it uses their sum, which tells as much
/// and takes less time.
template <class T>
std::uint64_t cost(const T* differences, std::size_t count) {
    std::uint64_t sum = 0;
    std::size_t i = 0;
    const auto folded = [](T d) {
        return static_cast<T>((d << 1) ^ (d >> (8 * sizeof(T) - 1) ? ~T{0} : T{0}));
    };
    if constexpr (sizeof(T) == 1) {
        const hn::ScalableTag<std::uint8_t> d;
        const hn::Repartition<std::uint64_t, decltype(d)> wide;
        auto sums = hn::Zero(wide);
        for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
            const auto value = hn::LoadU(d, differences + i);
            const hn::RebindToSigned<decltype(d)> s;
            const auto sign = hn::BitCast(d, hn::BroadcastSignBit(hn::BitCast(s, value)));
            sums = hn::Add(sums, hn::SumsOf8(hn::Xor(hn::Add(value, value), sign)));
        }
        sum = hn::GetLane(hn::SumOfLanes(wide, sums));
        for (; i < count; ++i)
            sum += folded(differences[i]);
    } else {
        for (; i < count; ++i)
            sum += static_cast<std::uint64_t>(std::bit_width(folded(differences[i])));
    }
    return sum;
}

template <class T>
unsigned find_least(const std::array<std::uint32_t, 3>& size, const T* values,
                    const std::array<T*, 3>& space, T* shuffled) {
    const std::size_t row = size[0], plane = row * size[1], count = plane * size[2];
    const std::array<std::size_t, 3> step{1, row, plane}, block{row, plane, count};
    std::uint64_t least = ~std::uint64_t{0};
    unsigned best = 0;
    for (unsigned axis = 0; axis < 3; ++axis) {
        take_differences(values, count, block[axis], step[axis], space[axis]);
        values = space[axis];
        if (const std::uint64_t found = cost(values, count); found < least) {
            least = found;
            best = axis;
        }
    }
    if constexpr (sizeof(T) > 1) {
        const auto* HWY_RESTRICT bytes = reinterpret_cast<const std::uint8_t*>(space[best]);
        auto* HWY_RESTRICT out = reinterpret_cast<std::uint8_t*>(shuffled);
        for (std::size_t byte = 0; byte < sizeof(T); ++byte)
            for (std::size_t i = 0; i < count; ++i)
                *out++ = bytes[i * sizeof(T) + byte];
    }
    return best;
}

unsigned find_best(const std::array<std::uint32_t, 3>& size, std::size_t word,
                   const std::byte* values, const std::array<std::uint64_t*, 4>& space) {
    const auto find = [&]<class T>(T*) {
        const auto as = [](std::uint64_t* words) { return reinterpret_cast<T*>(words); };
        return find_least<T>(size, reinterpret_cast<const T*>(values),
                             {as(space[0]), as(space[1]), as(space[2])}, as(space[3]));
    };
    switch (word) {
    case 1: return find(static_cast<std::uint8_t*>(nullptr));
    case 2: return find(static_cast<std::uint16_t*>(nullptr));
    case 4: return find(static_cast<std::uint32_t*>(nullptr));
    default: break;
    }
    return find(static_cast<std::uint64_t*>(nullptr));
}

} // namespace
} // namespace isochron::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isochron::index {

HWY_EXPORT(find_best);

unsigned ChunkDifferences::find(const std::array<std::uint32_t, 3>& size, std::size_t word,
                                std::span<const std::byte> values) {
    std::array<std::uint64_t*, 4> space{};
    for (std::size_t i = 0; i < space.size(); ++i) {
        words_[i].resize(std::max(words_[i].size(), (values.size() + 7) / 8));
        space[i] = words_[i].data();
    }
    const unsigned best = HWY_DYNAMIC_DISPATCH(find_best)(size, word, values.data(), space);
    best_ = std::as_bytes(std::span(words_[word > 1 ? 3 : best])).first(values.size());
    return best + 1;
}

} // namespace isochron::index
#endif
