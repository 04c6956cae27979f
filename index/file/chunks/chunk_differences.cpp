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
    if (step == 1) { // single values, for each of which a call of `memcpy` would take longer
        for (std::size_t first = 0; first < count; first += block)
            out[first] = values[first];
        return;
    }
    for (std::size_t first = 0; first < count; first += block)
        std::copy_n(values + first, step, out + first);
}

/// Signed differences as unsigned numbers: 2 d, or -2 d - 1 where d is negative.
template <class T>
T folded(T d) {
    return static_cast<T>((d << 1) ^ (d >> (8 * sizeof(T) - 1) ? ~T{0} : T{0}));
}

/// Estimates the bits that the differences take. For bytes it uses their sum, which tells as much
/// and takes less time.
template <class T>
std::uint64_t cost(const T* differences, std::size_t count) {
    std::uint64_t sum = 0;
    std::size_t i = 0;
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

/// Estimates the number of bits of rows of 16 of the differences, folded, each of which takes as many
/// as its largest. Of rows of a whole chunk it looks at four in a plane, others in the next plane.
template <class T>
std::uint64_t bits_of_rows(const T* differences, std::size_t count) {
    constexpr std::size_t kRow = 16, kOneOf = 4;
    const std::size_t rows = count / kRow;
    std::uint64_t sum = 0, looked_at = 0;
    for (std::size_t row = 0; row < rows; ++row) {
        if (rows >= kRow && (row + row / kRow) % kOneOf != 0)
            continue;
        T all = 0;
        for (std::size_t k = 0; k < kRow; ++k)
            all = static_cast<T>(all | folded(differences[row * kRow + k]));
        sum += static_cast<std::uint64_t>(std::bit_width(all));
        ++looked_at;
    }
    return looked_at > 0 ? sum * rows / looked_at : 0;
}

/// Puts the first bytes of all values first, then all second bytes, and so on.
template <class T>
void shuffle(const T* values, std::size_t count, T* shuffled) {
    const auto* HWY_RESTRICT bytes = reinterpret_cast<const std::uint8_t*>(values);
    auto* HWY_RESTRICT out = reinterpret_cast<std::uint8_t*>(shuffled);
    for (std::size_t byte = 0; byte < sizeof(T); ++byte)
        for (std::size_t i = 0; i < count; ++i)
            *out++ = bytes[i * sizeof(T) + byte];
}

/// The number of lowest bits that are zero in all values, some of which are not.
template <class T>
unsigned common_zeros(const T* values, std::size_t count) {
    T all = 0;
    for (std::size_t i = 0; i < count && (all & 1) == 0;)
        for (const std::size_t end = std::min(count, i + 64); i < end; ++i)
            all = static_cast<T>(all | values[i]);
    return static_cast<unsigned>(std::countr_zero(all));
}

template <class T>
Differences find_least(const std::array<std::uint32_t, 3>& size, bool rows, const T* values,
                       const std::array<T*, 3>& space, T* shuffled) {
    const std::size_t row = size[0], plane = row * size[1], count = plane * size[2];
    const std::array<std::size_t, 3> step{1, row, plane}, block{row, plane, count};
    std::uint64_t least = ~std::uint64_t{0};
    Differences best;
    if constexpr (sizeof(T) > 1)
        best.shift = rows ? common_zeros(values, count) : 0;
    if (best.shift > 0) {
        std::transform(values, values + count, shuffled,
                       [&](T value) { return static_cast<T>(value >> best.shift); });
        values = shuffled;
    }
    for (unsigned axis = 0; axis < 3; ++axis) {
        take_differences(values, count, block[axis], step[axis], space[axis]);
        values = space[axis];
        const std::uint64_t found =
            sizeof(T) > 1 && rows ? bits_of_rows(values, count) : cost(values, count);
        if (found < least) {
            least = found;
            best.axes = axis + 1;
        }
    }
    best.bytes_of_rows = static_cast<std::size_t>(2 * least);
    T* const chosen = space[best.axes - 1];
    if constexpr (sizeof(T) > 1) {
        if (rows)
            std::transform(chosen, chosen + count, chosen, folded<T>);
        shuffle(chosen, count, shuffled);
    }
    return best;
}

Differences find_best(const std::array<std::uint32_t, 3>& size, std::size_t word, bool rows,
                      const std::byte* values, const std::array<std::uint64_t*, 4>& space) {
    const auto find = [&]<class T>(T*) {
        const auto as = [](std::uint64_t* words) { return reinterpret_cast<T*>(words); };
        return find_least<T>(size, rows, reinterpret_cast<const T*>(values),
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

Differences ChunkDifferences::find(const std::array<std::uint32_t, 3>& size, std::size_t word,
                                   std::span<const std::byte> values, bool rows) {
    std::array<std::uint64_t*, 4> space{};
    for (std::size_t i = 0; i < space.size(); ++i) {
        words_[i].resize(std::max(words_[i].size(), (values.size() + 7) / 8));
        space[i] = words_[i].data();
    }
    const Differences best =
        HWY_DYNAMIC_DISPATCH(find_best)(size, word, rows, values.data(), space);
    best_ = std::as_bytes(std::span(words_[word > 1 ? 3 : best.axes - 1])).first(values.size());
    return best;
}

} // namespace isochron::index
#endif
