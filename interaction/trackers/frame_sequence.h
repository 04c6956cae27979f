// Checks the frame counter of a tracker's frames: drops late frames, counts missing ones.
#pragma once

#include "interaction/pose.h"

#include <cstdint>
#include <optional>

namespace isochron::interaction {

/// Counters have 32 bits and wrap around. A counter that goes back by at most 1000 is of a frame
/// that was overtaken. One that jumps by more than 1000 either way, or that follows a silence of
/// more than 0.5 s, is of a sender that has started over.
class FrameSequence {
  public:
    /// @return whether to use the frame: it is newer than all before, or its sender started over
    bool accept(std::uint32_t counter, Seconds arrival);

    std::uint64_t accepted() const { return accepted_; }
    std::uint64_t missing() const { return missing_; } ///< frames that never came, or came late
    std::uint64_t late() const { return late_; }

  private:
    struct Newest {
        std::uint32_t counter;
        Seconds arrival;
    };
    std::optional<Newest> newest_;
    std::uint64_t accepted_ = 0, missing_ = 0, late_ = 0;
};

} // namespace isochron::interaction
