// A text without the blanks around it.
#pragma once

#include <string_view>

namespace isochron::index {

/// Blanks are spaces, tabulators and ends of lines.
inline std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\r\n";
    const std::size_t begin = text.find_first_not_of(kBlanks);
    if (begin == text.npos)
        return {};
    return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

} // namespace isochron::index
