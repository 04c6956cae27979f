// Chooses the levels by which the bricks of a step are indexed, while the step is read.
//
//     index::LevelChooser chooser(type);
//     chooser.add(stored);
//     const LevelMap levels = chooser.choose();
#pragma once

#include "index/volume/level_map.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// Chooses lossless levels if possible: always for 8-bit types, and for other types if the step has
/// at most 256 distinct values. Otherwise it chooses 255 thresholds that divide both the values and
/// their range as evenly as possible. Each of the two goals has half of the weight, so that neither a
/// constant background nor a few outliers take all levels. Any levels give exact results; better ones
/// leave fewer bricks to test.
///
/// The choice depends on the step only, not on how it was cut into parts: the number of vertices
/// determines which of them are samples.
class LevelChooser {
  public:
    explicit LevelChooser(ValueType type) : type_(type) {}

    /// @param stored all values of the step
    void add(std::span<const std::byte> stored) {
        const std::size_t values = stored.size() / size_of(type_);
        add({0, values, values}, stored);
    }
    /// A part of a step's values: those from `first` to `end` - 1, of `all` values.
    struct Part {
        std::size_t first, end, all;
    };
    /// Adds a part of the values of the step.
    void add(const Part& part, std::span<const std::byte> stored);
    LevelMap choose() const;

  private:
    template <class T>
    void add_values(const Part& part, const T* values);
    void take_distinct(std::vector<std::uint64_t> ordinals);

    ValueType type_;
    bool many_ = false;                   ///< more than 256 distinct values
    std::vector<std::uint64_t> distinct_; ///< ordinals, ascending; empty when there are many
    std::vector<std::uint64_t> samples_;  ///< ordinals
};

} // namespace isochron::index
