// Patterns of names, as shells have them: `t_*.vti`.
#pragma once

#include <fnmatch.h>

#include <string>
#include <string_view>

namespace isochron::index {

/// A pattern of which some characters stand for themselves.
inline std::string escaped(std::string_view pattern, std::string_view characters) {
    std::string text;
    for (const char c : pattern) {
        if (characters.find(c) != characters.npos)
            text += '\\';
        text += c;
    }
    return text;
}

/// Whether a name matches a pattern. Brackets, as in `Pressure [Pa]`, may be a set of characters or
/// stand for themselves.
/// @param flags of fnmatch(3)
inline bool matches_pattern(const std::string& pattern, const std::string& name, int flags = 0) {
    return ::fnmatch(pattern.c_str(), name.c_str(), flags) == 0 ||
           ::fnmatch(escaped(pattern, "[").c_str(), name.c_str(), flags) == 0;
}

} // namespace isochron::index
