// Gaps of a series: where steps are blended, the step before a gap is held.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace isochron::interaction {

/// The steps behind which a series has a gap. Time that plays between the steps shows the step before
/// a gap until the step behind it; an instant in a gap is shown to whoever asks for it.
class StepGaps {
  public:
    StepGaps() = default;
    /// @param steps ascending
    explicit StepGaps(std::vector<std::uint32_t> steps) : steps_(std::move(steps)) {}

    /// Whether there is a gap between a step and the next one.
    bool behind(std::uint32_t step) const { return std::ranges::binary_search(steps_, step); }
    /// All of them, ascending.
    const std::vector<std::uint32_t>& steps() const { return steps_; }

  private:
    std::vector<std::uint32_t> steps_;
};

/// When the steps of a series are, and its gaps.
struct StepTimes {
    std::vector<double> at; ///< physical times, increasing
    StepGaps gaps = {};
};

} // namespace isochron::interaction
