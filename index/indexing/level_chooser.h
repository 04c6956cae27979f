// Chooses the levels by which a series is indexed, while its steps are read.
//
//     index::LevelChooser chooser(type);               // one for each thread or process
//     chooser.add(step, stored);                       // every step once, in any order
//     chooser.merge(other);                            // in any order
//     const LevelMap levels = chooser.choose();
#pragma once

#include "index/volume/level_map.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// Chooses lossless levels if possible: always for 8-bit types, and for other types if the series
/// has at most 256 distinct values. Otherwise it chooses 255 thresholds that divide both the values
/// and their range as evenly as possible. Each of the two goals has half of the weight, so that
/// neither a constant background nor a few outliers take all levels. Any levels give exact results;
/// better ones leave fewer bricks to test.
///
/// The choice depends on the series only, not on the order of steps or on which thread saw a step:
/// the number of a step determines which of its values are samples, and the samples with the lowest
/// hashes are kept.
class LevelChooser {
  public:
    /// Default number of values of a step that are looked at.
    static constexpr std::size_t kSamplesPerStep = 1 << 11;

    explicit LevelChooser(ValueType type, std::size_t samples_per_step = kSamplesPerStep)
        : type_(type), samples_per_step_(samples_per_step) {}

    /// @param step number in the series @param stored all values of the step
    void add(std::size_t step, std::span<const std::byte> stored) {
        const std::size_t values = stored.size() / size_of(type_);
        add(step, {0, values, values}, stored);
    }
    /// A part of a step's values: those from `first` to `end` - 1, of `all` values.
    struct Part {
        std::size_t first, end, all;
    };
    /// Adds a part of the values of a step. How a step is cut into parts does not change the
    /// choice.
    void add(std::size_t step, const Part& part, std::span<const std::byte> stored);
    /// Takes over what another chooser of the same type has seen of other steps.
    void merge(const LevelChooser& other);
    LevelMap choose() const;
    /// Whether the values seen so far can have lossless levels.
    bool lossless() const { return !many_; }

    /// Its whole state, to be sent to another process: a few to 130,000 numbers.
    std::vector<std::uint64_t> state() const;
    /// Restores a `state()` of a chooser of the same type.
    LevelChooser(ValueType type, std::span<const std::uint64_t> state);

  private:
    struct Sample {
        std::uint64_t hash, ordinal;
    };

    template <class T>
    void add_values(std::size_t step, const Part& part, const T* values);
    void take_distinct(std::vector<std::uint64_t> ordinals);
    static void keep_lowest_hashes(std::vector<Sample>& samples);

    ValueType type_;
    std::size_t samples_per_step_ = kSamplesPerStep;
    bool many_ = false;                   ///< more than 256 distinct values
    std::vector<std::uint64_t> distinct_; ///< ordinals, ascending; empty when there are many
    std::vector<Sample> samples_;         ///< reduced to the lowest hashes from time to time
};

/// A chooser for the bricks of one step, whose levels depend on that step's values only. Add them
/// as step 0.
inline LevelChooser chooser_of_one_step(ValueType type) {
    constexpr std::size_t kSamplesOfOneStep = 1 << 14;
    return LevelChooser(type, kSamplesOfOneStep);
}

} // namespace isochron::index
