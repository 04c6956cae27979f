// What a web server answers to a request for ranges of bytes (RFC 9110, section 14): nothing in it is trusted.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::index {

/// Bytes from `begin` to before `end`.
struct LinkRange {
    std::uint64_t begin = 0, end = 0;
    std::uint64_t bytes() const { return end - begin; }
    bool operator==(const LinkRange&) const = default;
};

/// The header Range that asks for these.
std::string range_header(std::span<const LinkRange> ranges);

/// The header Content-Range.
struct ContentRange {
    LinkRange range;
    std::uint64_t total = 0; ///< bytes of the file
};
/// @return nothing where the header is none, says no total, or the range does not lie within it
std::optional<ContentRange> content_range(std::string_view header);

/// The boundary of a multipart answer, from the header Content-Type; empty: it is none.
std::string boundary_of(std::string_view content_type);

/// A part of a multipart answer; its bytes are those of the body.
struct AnswerPart {
    ContentRange where;
    std::string_view bytes;
};
/// The parts up to the first that is damaged or cut.
std::vector<AnswerPart> parts_of(std::string_view body, std::string_view boundary);

/// A tag that names one content and no other; empty where the header ETag has none, or a weak one.
std::string strong_tag(std::string_view etag);

} // namespace isochron::index
