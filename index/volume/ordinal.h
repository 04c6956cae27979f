// Ordinals: whole numbers in the order of the stored values, for every stored type.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace isochron::index {

/// A type wide enough for the ordinals of T.
template <class T>
using Ordinal = std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t>;

/// Whether a value is NaN; false for every whole number.
template <class T>
constexpr bool is_nan(T stored) {
    if constexpr (std::is_floating_point_v<T>)
        return std::isnan(stored);
    return false;
}

/// `a < b` if and only if `ordinal(a) < ordinal(b)`, infinities included; -0 and +0 are one value.
/// The ordinal of a NaN has no meaning.
template <class T>
constexpr Ordinal<T> ordinal(T stored) {
    if constexpr (std::is_floating_point_v<T>) {
        constexpr auto kSign = Ordinal<T>{1} << (8 * sizeof(T) - 1);
        // Adding +0 turns -0 into +0 and leaves everything else as it is.
        const auto bits = std::bit_cast<Ordinal<T>>(stored + T{0});
        return bits & kSign ? ~bits : bits | kSign;
    } else {
        return static_cast<std::uint32_t>(static_cast<std::int64_t>(stored) -
                                          std::numeric_limits<T>::lowest());
    }
}

/// The value that has this ordinal.
template <class T>
constexpr T from_ordinal(Ordinal<T> number) {
    if constexpr (std::is_floating_point_v<T>) {
        constexpr auto kSign = Ordinal<T>{1} << (8 * sizeof(T) - 1);
        return std::bit_cast<T>(number & kSign ? number ^ kSign : ~number);
    } else {
        return static_cast<T>(std::numeric_limits<T>::lowest() + std::int64_t{number});
    }
}

template <class T>
constexpr Ordinal<T> lowest_ordinal() {
    if constexpr (std::is_floating_point_v<T>)
        return ordinal(-std::numeric_limits<T>::infinity());
    else
        return 0;
}

template <class T>
constexpr Ordinal<T> highest_ordinal() {
    if constexpr (std::is_floating_point_v<T>)
        return ordinal(std::numeric_limits<T>::infinity());
    else
        return ordinal(std::numeric_limits<T>::max());
}

/// The smallest number in [first, end) for which `holds` is true; `end` if there is none. Once
/// true, `holds` must be true for all greater numbers.
template <class Holds>
constexpr std::uint64_t first_that(std::uint64_t first, std::uint64_t end, Holds&& holds) {
    while (first < end) {
        const std::uint64_t middle = first + (end - first) / 2;
        if (holds(middle))
            end = middle;
        else
            first = middle + 1;
    }
    return end;
}

} // namespace isochron::index
