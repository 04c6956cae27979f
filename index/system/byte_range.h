// Parts of a file that are announced or read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace isochron::index {

/// Some bytes of a file.
struct ByteRange {
    std::uint64_t offset = 0, bytes = 0;
};
/// Bytes that are to be read, and where to.
struct RangeRead {
    std::uint64_t offset = 0;
    std::span<std::byte> out;
};

} // namespace isochron::index
