// Memory that the blends of a store's steps share: of chunks that an earlier moment no longer
// needs, to be used again, and of tables of ranks.
#pragma once

#include "index/file/chunks/byte_cache.h"
#include "index/system/huge_pages.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace isochron::index {

/// Keeps memory for the next use: the system clears new memory, which takes longer than the blend
/// of two chunks. Thread-safe.
class SpareMemory {
  public:
    using Doubles = std::unique_ptr<double[]>;
    /// @param count doubles that memory must have room for
    /// @param limit bytes that are kept
    SpareMemory(std::size_t count, std::size_t limit)
        : count_(count), most_(limit / (count * sizeof(double))) {}

    /// Room for `count` doubles, with undefined contents.
    Doubles take() {
        {
            const std::scoped_lock lock(mutex_);
            if (!free_.empty()) {
                Doubles memory = std::move(free_.back());
                free_.pop_back();
                return memory;
            }
        }
        return std::make_unique_for_overwrite<double[]>(count_);
    }
    void give_back(Doubles memory) {
        const std::scoped_lock lock(mutex_);
        if (free_.size() < most_)
            free_.push_back(std::move(memory));
    }

  private:
    const std::size_t count_, most_;
    std::mutex mutex_;
    std::vector<Doubles> free_;
};

/// What all views of one moment share, as views come and go: a search has several, and each look at
/// a place has one, which takes less time than making ranks. Thread-safe.
struct BlendMemory {
    /// @param chunk doubles of a blended chunk @param limit bytes of them that are kept
    BlendMemory(std::size_t chunk, std::size_t limit)
        : spare(std::make_shared<SpareMemory>(chunk, limit)), ranks(kRankBytes) {}

    static constexpr std::uint64_t kRankBytes = 2 << 20; ///< bytes of ranks: about 15 moments
    std::shared_ptr<SpareMemory> spare;                  ///< blended chunks may outlive the store
    ByteCache ranks;                                     ///< by the number of the moment

    /// Memory of a step's blends, with undefined contents, where the last one given back is as large.
    LargeMemory take_step(std::uint64_t bytes) {
        {
            const std::scoped_lock lock(mutex_);
            if (step_ && step_bytes_ == bytes)
                return std::move(step_);
        }
        return large_memory(bytes);
    }
    void give_back_step(LargeMemory memory, std::uint64_t bytes) {
        const std::scoped_lock lock(mutex_);
        step_ = std::move(memory);
        step_bytes_ = bytes;
    }

  private:
    std::mutex mutex_;
    LargeMemory step_;
    std::uint64_t step_bytes_ = 0;
};

} // namespace isochron::index
