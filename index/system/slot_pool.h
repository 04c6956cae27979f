// Memory for many things of the same size, whose pages come together.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

namespace isochron::index {

/// Gives pieces of one size out of blocks of 2 MiB, whose pages come many at a time: fresh memory
/// costs as much as decoding into it. A block goes back when nothing of it is in use, but for one.
/// Thread-safe.
class SlotPool {
  public:
    /// @param bytes of a slot, at most 1 MiB
    explicit SlotPool(std::size_t bytes);
    ~SlotPool(); ///< all slots have been given back
    SlotPool(const SlotPool&) = delete;
    SlotPool& operator=(const SlotPool&) = delete;

    /// Aligned to 64 bytes; its content has no meaning. @throws std::bad_alloc
    std::byte* take();
    /// @param slot from `take`
    void give_back(std::byte* slot);

    /// What the blocks take together.
    std::size_t bytes() const;

  private:
    struct Block;

    const std::size_t bytes_;
    mutable std::mutex mutex_;
    std::vector<Block*> free_; ///< blocks that have a free slot
    std::size_t blocks_ = 0;
};

} // namespace isochron::index
