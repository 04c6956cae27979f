// Prepares a chunk for packing: takes differences of neighboring values along as many axes as make
// them smallest, and orders their bytes by weight.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// The differences that are likely to take the fewest bits.
struct Differences {
    unsigned axes = 0;  ///< they are along: 1 (x), 2 (x, y) or 3 (x, y, z)
    unsigned shift = 0; ///< the values were shifted right by so many bits, all zero, before
    /// What their rows of 16 take, without the widths: an estimate.
    std::size_t bytes_of_rows = 0;
};

/// Keeps its work space: one for each thread.
class ChunkDifferences {
  public:
    /// Takes differences of the bit patterns, as unsigned numbers, along x; then differences of
    /// these differences along y, and of the results along z. Finds which of the three results is
    /// likely to take the fewest bits.
    /// @param size values along x, y and z @param word bytes of a value: 1, 2, 4 or 8
    /// @param rows the differences will be in packed rows. Then values of several bytes are shifted
    ///   first, and their differences folded: 2 d, or -2 d - 1 where d is negative
    Differences find(const std::array<std::uint32_t, 3>& size, std::size_t word,
                     std::span<const std::byte> values, bool rows);

    /// The best differences: the first bytes of all, then all second bytes, and so on.
    std::span<const std::byte> shuffled() const { return best_; }

  private:
    std::array<std::vector<std::uint64_t>, 4> words_; ///< by axis, and shuffled
    std::span<const std::byte> best_;
};

} // namespace isochron::index
