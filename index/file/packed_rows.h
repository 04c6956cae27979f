// Small numbers of one byte in as few bits as the largest of each 16 takes.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace isochron::index {

// What they take is read as fast as memory, which what a library packs is not, and packed in a
// fraction of the time; of differences of neighbors it takes some tenths more bytes.
//
// Signed numbers d, as bytes, are folded to 2 d or -2 d - 1. Of each 16 in a row, the last ones
// filled up with zeros, first come the bits that the largest takes: 4 bits each, the first one's
// lower, and where their number is odd a zero behind. Then come, one after the other, the planes of
// bits of each 16, the lowest first: 2 bytes each, bit i of the i-th number.

/// Appends the packed numbers.
void pack_rows(std::span<const std::byte> numbers, std::vector<std::byte>& out);

/// The inverse. @param out as long as the numbers
/// @return false where the bytes are not what so many numbers give
bool unpack_rows(std::span<const std::byte> packed, std::span<std::byte> out);

} // namespace isochron::index
