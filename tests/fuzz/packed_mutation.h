// Mutates the compressed contents of a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace isochron::fuzz {

/// Changes up to `size` bytes at `data`, which may grow to `most`. @return their new number
using Mutate = std::size_t (*)(std::uint8_t* data, std::size_t size, std::size_t most);

/// Unpacks the gzip, zlib or bzip2 stream that ends a file, changes what was in it, and packs it
/// again. @param data has room for `most` bytes
/// @return the new size; none where there is no such stream, or the result has no room
std::optional<std::size_t> mutate_packed(std::span<std::uint8_t> data, std::size_t most,
                                         unsigned seed, Mutate mutate);

} // namespace isochron::fuzz
