// A text in lower case, for words that files spell in either.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace isochron::index {

/// The ASCII letters of a text in lower case; other bytes stay.
inline std::string lower_case(std::string_view text) {
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return lower;
}

} // namespace isochron::index
