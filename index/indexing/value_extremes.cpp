// The lowest and the highest of stored values, many at a time.
#include "index/indexing/value_extremes.h"

#include "index/volume/ordinal.h"

#include <algorithm>
#include <array>
#include <limits>
#include <type_traits>

namespace isochron::index {
namespace {

/// Values that are compared side by side, so that the compiler can use whole vectors.
constexpr std::size_t kLanes = 32;

template <class T>
struct Bounds {
    std::array<T, kLanes> low, high;
};

template <class T>
constexpr T above_all() {
    if constexpr (std::is_floating_point_v<T>)
        return std::numeric_limits<T>::infinity();
    else
        return std::numeric_limits<T>::max();
}

template <class T>
constexpr T below_all() {
    if constexpr (std::is_floating_point_v<T>)
        return -std::numeric_limits<T>::infinity();
    else
        return std::numeric_limits<T>::lowest();
}

template <class T>
void add_lanes(const T* values, std::size_t count, Bounds<T>& bounds) {
    std::array<T, kLanes> low = bounds.low, high = bounds.high;
    for (std::size_t at = 0; at + kLanes <= count; at += kLanes)
        for (std::size_t i = 0; i < kLanes; ++i) { // false for NaN
            low[i] = values[at + i] < low[i] ? values[at + i] : low[i];
            high[i] = values[at + i] > high[i] ? values[at + i] : high[i];
        }
    bounds = {low, high};
}

} // namespace

void add_extremes(ValueType type, std::span<const std::byte> stored,
                  std::optional<LevelMap::Extremes>& extremes) {
    visit_value_type(type, [&]<class T>(std::type_identity<T>) {
        const T* const values = reinterpret_cast<const T*>(stored.data());
        const std::size_t count = stored.size() / sizeof(T);
        Bounds<T> bounds;
        bounds.low.fill(above_all<T>());
        bounds.high.fill(below_all<T>());
        add_lanes(values, count, bounds);
        T low = std::ranges::min(bounds.low), high = std::ranges::max(bounds.high);
        for (std::size_t i = count / kLanes * kLanes; i < count; ++i) {
            low = values[i] < low ? values[i] : low;
            high = values[i] > high ? values[i] : high;
        }
        if (low > high) // NaN alone
            return;
        const std::uint64_t first = ordinal(low), last = ordinal(high);
        extremes = extremes ? LevelMap::Extremes{std::min(extremes->low, first),
                                                 std::max(extremes->high, last)}
                            : LevelMap::Extremes{first, last};
    });
}

} // namespace isochron::index
