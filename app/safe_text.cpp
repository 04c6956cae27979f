// Spells out what terminals would obey.
#include "app/safe_text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

namespace isochron::app {
namespace {

/// A character of UTF-8, or a byte that belongs to none.
struct Character {
    char32_t code = 0;
    std::size_t bytes = 1;
    bool valid = false;
};

Character first_of(std::string_view text) {
    const auto lead = static_cast<unsigned char>(text[0]);
    if (lead < 0x80)
        return {lead, 1, true};
    const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    if (lead < 0xc2 || lead > 0xf4 || text.size() < bytes)
        return {lead, 1, false};
    char32_t code = lead & (0x7fu >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
        const auto next = static_cast<unsigned char>(text[i]);
        if ((next & 0xc0) != 0x80)
            return {lead, 1, false};
        code = code << 6 | (next & 0x3f);
    }
    constexpr std::array<char32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
    const bool valid =
        code >= kLeast[bytes] && code <= 0x10ffff && (code < 0xd800 || code > 0xdfff);
    return valid ? Character{code, bytes, true} : Character{lead, 1, false};
}

/// What a terminal obeys, or what shows text otherwise than it is stored: control characters,
/// line and paragraph ends, marks, embeddings, overrides and isolates of direction.
bool commands(char32_t code) {
    return code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0x61c || code == 0x200e ||
           code == 0x200f || (code >= 0x2028 && code <= 0x202e) ||
           (code >= 0x2066 && code <= 0x2069);
}

enum class Spelling { words, data };

std::string spelled(std::string_view text, bool lines_stay, Spelling spelling) {
    std::string safe;
    while (!text.empty()) {
        const Character next = first_of(text);
        if (next.valid && (!commands(next.code) || (lines_stay && next.code == '\n')))
            safe += text.substr(0, next.bytes);
        else if (spelling == Spelling::data)
            safe += next.valid ? fmt::format("\\u{:04x}", static_cast<unsigned>(next.code))
                               : std::string("\ufffd");
        else if (next.code == '\n' || next.code == '\t')
            safe += next.code == '\n' ? "\\n" : "\\t";
        else if (next.code < 0x100)
            safe += fmt::format("\\x{:02x}", static_cast<unsigned>(next.code));
        else
            safe += fmt::format("\\u{:04x}", static_cast<unsigned>(next.code));
        text.remove_prefix(next.bytes);
    }
    return safe;
}

/// Where a text may be cut at or before a place without parting a character.
std::size_t cut(std::string_view text, std::size_t place) {
    constexpr std::size_t kLongestCharacter = 4;
    for (std::size_t back = 0; back < kLongestCharacter; ++back)
        if ((static_cast<unsigned char>(text[place - back]) & 0xc0) != 0x80)
            return place - back;
    return place;
}

} // namespace

std::string one_line(std::string_view text) {
    constexpr std::size_t kLongest = 2000, kEnd = 500;
    if (text.size() > kLongest)
        return one_line(text.substr(0, cut(text, kLongest - kEnd))) + " ... " +
               one_line(text.substr(cut(text, text.size() - kEnd)));
    return spelled(text, false, Spelling::words);
}

SafeText SafeText::lines(std::string_view text) {
    SafeText safe;
    safe.text_ = spelled(text, true, Spelling::words);
    return safe;
}

SafeText SafeText::data(std::string_view text) {
    SafeText safe;
    safe.text_ = spelled(text, true, Spelling::data);
    return safe;
}

SafeText SafeText::json(const nlohmann::ordered_json& value, int indent) {
    return data(value.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
}

void print_safely(const SafeText& text, std::FILE* out) {
    // What cannot be written is told at the end of the program, which looks at the stream's error.
    std::fwrite(text.str().data(), 1, text.str().size(), out);
}

} // namespace isochron::app
