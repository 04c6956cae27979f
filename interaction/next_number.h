// The name of the next one of a list.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace isochron::interaction {

/// The first of 1, 2, 3, ... that is nobody's `name`.
template <class T>
std::string next_number(const std::vector<T>& named) {
    std::size_t number = 1;
    while (std::ranges::find(named, std::to_string(number), &T::name) != named.end())
        ++number;
    return std::to_string(number);
}

} // namespace isochron::interaction
