// Takes answers to requests for ranges apart.
#include "index/system/links/range_answer.h"

#include "index/lower_case.h"
#include "index/trimmed.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace isochron::index {
namespace {

/// A number without a sign, which a file's size can be.
std::optional<std::uint64_t> number_in(std::string_view text) {
    constexpr std::uint64_t kMost = std::uint64_t{1} << 62;
    std::uint64_t number = 0;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, number);
    return !text.empty() && read.ec == std::errc() && read.ptr == end && number <= kMost
               ? std::optional(number)
               : std::nullopt;
}

} // namespace

std::string range_header(std::span<const LinkRange> ranges) {
    std::string header = "Range: bytes=";
    for (const LinkRange& range : ranges)
        header +=
            fmt::format("{}{}-{}", header.back() == '=' ? "" : ",", range.begin, range.end - 1);
    return header;
}

std::optional<ContentRange> content_range(std::string_view header) {
    header = trimmed(header);
    if (header.size() < 6 || lower_case(header.substr(0, 6)) != "bytes ")
        return std::nullopt;
    header.remove_prefix(6);
    const std::size_t dash = header.find('-'), slash = header.find('/');
    if (dash == header.npos || slash == header.npos || slash < dash)
        return std::nullopt;
    const auto first = number_in(trimmed(header.substr(0, dash)));
    const auto last = number_in(trimmed(header.substr(dash + 1, slash - dash - 1)));
    const auto total = number_in(trimmed(header.substr(slash + 1)));
    if (!first || !last || !total || *last < *first || *last >= *total)
        return std::nullopt;
    return ContentRange{{*first, *last + 1}, *total};
}

std::string boundary_of(std::string_view content_type) {
    constexpr std::size_t kLongest = 200;
    if (lower_case(trimmed(content_type.substr(0, content_type.find(';')))) !=
        "multipart/byteranges")
        return {};
    while (content_type.find(';') != content_type.npos) {
        content_type.remove_prefix(content_type.find(';') + 1);
        std::string_view word = trimmed(content_type.substr(0, content_type.find(';')));
        if (word.size() < 9 || lower_case(word.substr(0, 9)) != "boundary=")
            continue;
        word.remove_prefix(9);
        if (word.size() >= 2 && word.front() == '"' && word.back() == '"')
            word = word.substr(1, word.size() - 2);
        return word.size() <= kLongest ? std::string(word) : std::string();
    }
    return {};
}

std::vector<AnswerPart> parts_of(std::string_view body, std::string_view boundary) {
    std::vector<AnswerPart> parts;
    const std::string line = fmt::format("--{}", boundary);
    std::size_t at = body.find(line);
    while (at != body.npos) {
        at += line.size();
        const std::size_t end = body.find("\r\n\r\n", at);
        if (body.substr(at, 2) == "--" || end == body.npos)
            break;
        std::optional<ContentRange> where;
        for (std::string_view head = body.substr(at, end - at); !head.empty();) {
            const std::string_view field = head.substr(0, head.find("\r\n"));
            head.remove_prefix(std::min(head.size(), field.size() + 2));
            const std::size_t colon = field.find(':');
            if (colon != field.npos &&
                lower_case(trimmed(field.substr(0, colon))) == "content-range")
                where = content_range(field.substr(colon + 1));
        }
        at = end + 4;
        if (!where || where->range.bytes() > body.size() - at)
            break;
        parts.push_back({*where, body.substr(at, where->range.bytes())});
        at += where->range.bytes();
        if (body.substr(at, 2) != "\r\n" || body.substr(at + 2, line.size()) != line)
            break;
        at += 2;
    }
    return parts;
}

std::string strong_tag(std::string_view etag) {
    etag = trimmed(etag);
    const bool is_tag = etag.size() > 2 && etag.size() <= 1024 && etag.front() == '"' &&
                        etag.back() == '"' &&
                        std::ranges::all_of(etag, [](char c) { return c > ' ' && c <= '~'; });
    return is_tag ? std::string(etag) : std::string();
}

} // namespace isochron::index
