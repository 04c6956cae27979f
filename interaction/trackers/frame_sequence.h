// Puts frames in order by their counter: late ones are dropped, missing ones are counted.
#pragma once

#include "interaction/pose.h"

#include <cstdint>
#include <optional>

namespace isochron::interaction {

/// Counters are 32 bits wide and wrap round. One that goes back by a little has been overtaken; one
/// that goes back by much, or after a silence, comes from a sender that has started over.
class FrameSequence {
  public:
    /// @return whether the frame is newer than all before
    bool accept(std::uint32_t counter, Seconds arrival);

    std::uint64_t accepted() const { return accepted_; }
    std::uint64_t missing() const { return missing_; } ///< never came, or came late
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
