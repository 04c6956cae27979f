// Reads `bytes=0-4095, 8192-, -64`.
#include "app/serve/range_request.h"

#include <algorithm>
#include <charconv>

namespace isochron::app {
namespace {

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
        text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t'))
        text.remove_suffix(1);
    return text;
}

std::optional<std::uint64_t> number(std::string_view text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || text.empty())
        return std::nullopt;
    return value;
}

} // namespace

std::optional<std::vector<ByteRange>> ranges_of(std::string_view header, std::uint64_t bytes) {
    constexpr std::string_view kUnit = "bytes=";
    header = trimmed(header);
    if (!header.starts_with(kUnit))
        return std::nullopt;
    header.remove_prefix(kUnit.size());
    std::vector<ByteRange> ranges;
    std::size_t asked = 0;
    for (bool last = false; !last;) {
        const std::size_t comma = header.find(',');
        last = comma == std::string_view::npos;
        const std::string_view one = trimmed(header.substr(0, comma));
        header.remove_prefix(last ? header.size() : comma + 1);
        const std::size_t dash = one.find('-');
        if (dash == std::string_view::npos || ++asked > kMostRanges)
            return std::nullopt;
        const auto first = number(one.substr(0, dash)), end = number(one.substr(dash + 1));
        if ((dash > 0 && !first) || (dash + 1 < one.size() && !end) || (!first && !end) ||
            (first && end && *end < *first))
            return std::nullopt;
        const ByteRange range = first ? ByteRange{*first, end && *end < bytes ? *end + 1 : bytes}
                                      : ByteRange{bytes - std::min(bytes, *end), bytes};
        if (range.begin < range.end)
            ranges.push_back(range);
    }
    return ranges;
}

} // namespace isochron::app
