// The first two steps of a level of detail, as values in memory for a search by brute force.
#pragma once

#include "index/file/index_file.h"
#include "index/volume/step_values.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace isochron::index {

/// Owns the values of steps 0 and 1 at a level of detail.
class LevelSteps {
  public:
    /// @throws Error as ChunkStore does
    LevelSteps(const std::shared_ptr<const IndexFile>& file, std::size_t level) {
        const LoadedStep now = file->chunks(level).whole(0), next = file->chunks(level).whole(1);
        values_ = now.values;
        both_.resize(2 * values_.stride / 8);
        auto* const bytes = reinterpret_cast<std::byte*>(both_.data());
        std::ranges::copy(now.values.step_bytes(0), bytes);
        std::ranges::copy(next.values.step_bytes(1), bytes + values_.stride);
        values_.first = bytes;
        values_.first_step = 0;
        values_.steps = 2;
    }
    LevelSteps(const LevelSteps&) = delete;
    LevelSteps& operator=(const LevelSteps&) = delete;

    const StepValues& view() const { return values_; }

  private:
    StepValues values_;
    std::vector<std::uint64_t> both_;
};

} // namespace isochron::index
