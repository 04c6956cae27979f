// Names of enumeration values, as used in files, on command lines and in panels.
//
// The table of names is beside its enumeration, in the order of the values:
//
//     template <>
//     inline constexpr std::array<std::string_view, 2> kNames<Hand>{"left", "right"};
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::interaction {

template <class Enum>
inline constexpr std::array<std::string_view, 0> kNames{};

template <class Enum>
concept Named = !kNames<Enum>.empty();

template <Named Enum>
constexpr std::string_view name_of(Enum value) {
    return kNames<Enum>[static_cast<std::size_t>(value)];
}

template <Named Enum>
constexpr std::optional<Enum> value_named(std::string_view name) {
    const auto found = std::ranges::find(kNames<Enum>, name);
    if (found == kNames<Enum>.end())
        return std::nullopt;
    return static_cast<Enum>(found - kNames<Enum>.begin());
}

template <Named Enum>
std::vector<std::string> all_names() {
    return {kNames<Enum>.begin(), kNames<Enum>.end()};
}

} // namespace isochron::interaction
