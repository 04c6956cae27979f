// The header Range of HTTP requests (RFC 9110, section 14).
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace isochron::app {

/// Bytes from `begin` to before `end`.
struct ByteRange {
    std::uint64_t begin = 0, end = 0;
    bool operator==(const ByteRange&) const = default;
};

/// Most ranges of one request; one with more is answered as if it had none.
constexpr std::size_t kMostRanges = 256;

/// The ranges that a header asks for, of a file of so many bytes: cut at its end, those beyond it left
/// out. @return nothing where the header is to be ignored: it is none that RFC 9110 knows, or asks for
/// too many; an empty list where none can be satisfied
std::optional<std::vector<ByteRange>> ranges_of(std::string_view header, std::uint64_t bytes);

} // namespace isochron::app
