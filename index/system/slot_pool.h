// Memory for many objects of the same size, whose pages are allocated many at a time.
#pragma once

#include "index/system/page_size_trials.h"

#include <cstddef>
#include <mutex>
#include <vector>

namespace isochron::index {

/// Gives slots of one size from blocks of 2 MiB. Pages of a block are allocated many at a time,
/// since fresh memory costs as much time as decoding into it; from the third block on all at once, in
/// the kind of pages that takes less time here. A block without used slots is freed, except for one.
/// Thread-safe.
class SlotPool {
  public:
    /// @param bytes of a slot, at most 1 MiB
    /// @param trials outlives this
    explicit SlotPool(std::size_t bytes, PageSizeTrials& trials = PageSizeTrials::of_process());
    ~SlotPool(); ///< all slots have been given back
    SlotPool(const SlotPool&) = delete;
    SlotPool& operator=(const SlotPool&) = delete;

    /// A slot, aligned to 64 bytes, with undefined contents. @throws std::bad_alloc
    std::byte* take();
    /// @param slot from `take`
    void give_back(std::byte* slot);

    /// The size of all blocks together.
    std::size_t bytes() const;

  private:
    struct Block;

    const std::size_t bytes_;
    PageSizeTrials& trials_;
    mutable std::mutex mutex_;
    std::vector<Block*> free_; ///< blocks that have a free slot
    std::size_t blocks_ = 0;
};

} // namespace isochron::index
