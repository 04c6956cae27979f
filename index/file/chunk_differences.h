// Differences of neighbors in a chunk: which of them are least, and their bytes in the order of
// their weight. What packing does before a library takes over.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// Keeps its work space: one for each thread.
class ChunkDifferences {
  public:
    /// Takes the differences of bit patterns as unsigned numbers along x, of these along y, and of
    /// these along z, and finds out which of the three are likely to take the fewest bits.
    /// @param size values along x, y and z @param word bytes of a value: 1, 2, 4 or 8
    /// @return along how many axes the best ones have been taken: 1, 2 or 3
    unsigned find(const std::array<std::uint32_t, 3>& size, std::size_t word,
                  std::span<const std::byte> values);

    /// The best ones: the first bytes of all, then all second bytes, and so on.
    std::span<const std::byte> shuffled() const { return best_; }

  private:
    std::array<std::vector<std::uint64_t>, 4> words_; ///< by axis, and shuffled
    std::span<const std::byte> best_;
};

} // namespace isochron::index
