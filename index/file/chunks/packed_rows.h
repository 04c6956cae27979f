// Packs small numbers: each row of 16 takes as many bits as its largest number needs.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace isochron::index {

// Rows unpack as fast as memory is read, and pack in a fraction of a compression library's time.
// Differences of neighbors take some tenths more bytes than with a library.
//
// Signed numbers d, as bytes, are folded to 2 d or -2 d - 1, and cut into rows of 16, the last one
// filled up with zeros. First comes the number of bits of each row: 4 bits each, the earlier row in
// the lower half of a byte; if the number of rows is odd, the last half is zero. Then come the bit
// planes of each row, the lowest bit first: 2 bytes each, bit i from the i-th number.

// Numbers of several bytes are unsigned. First comes the number of bits of each row, a byte each.
// Then, row after row, those lower bytes of the numbers that take all their bits: 16 bytes each, the
// lowest first; then the bit planes of the byte above them, as above.

/// Appends the packed numbers.
void pack_rows(std::span<const std::byte> numbers, std::vector<std::byte>& out);

/// The inverse. @param out as long as the numbers
/// @return false if the bytes are not the packed form of that many numbers
bool unpack_rows(std::span<const std::byte> packed, std::span<std::byte> out);

/// Packs unsigned numbers of `word` bytes, at most 8.
/// @param numbers the lowest bytes of all, then all second bytes, and so on
void pack_word_rows(std::span<const std::byte> numbers, std::size_t word,
                    std::vector<std::byte>& out);
/// The inverse, as `unpack_rows`.
bool unpack_word_rows(std::span<const std::byte> packed, std::size_t word,
                      std::span<std::byte> out);

} // namespace isochron::index
