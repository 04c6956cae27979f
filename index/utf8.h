// Text of files as UTF-8.
#pragma once

#include <string>

namespace isochron::index {

/// Whether the bytes are UTF-8, but for forms longer than need be.
inline bool is_utf8(const std::string& text) {
    for (std::size_t i = 0; i < text.size();) {
        const auto first = static_cast<unsigned char>(text[i++]);
        int more = first < 0x80 ? 0 : first < 0xc2 ? -1 : first < 0xe0 ? 1 : first < 0xf0 ? 2 : 3;
        if (more < 0 || first > 0xf4)
            return false;
        for (; more > 0; --more, ++i)
            if (i == text.size() || (static_cast<unsigned char>(text[i]) & 0xc0) != 0x80)
                return false;
    }
    return true;
}

/// Text that is not UTF-8 is read as Latin-1, the most common of the other encodings.
inline std::string as_utf8(const std::string& text) {
    if (is_utf8(text))
        return text;
    std::string utf8;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80)
            utf8 += c;
        else
            (utf8 += static_cast<char>(0xc0 | byte >> 6)) +=
                static_cast<char>(0x80 | (byte & 0x3f));
    }
    return utf8;
}

} // namespace isochron::index
