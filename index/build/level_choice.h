// Which levels a series is indexed by, chosen while its steps stream by.
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

/// Lossless levels where the series allows it: always for 8-bit types, and for other ones with at
/// most 256 values. Else 255 thresholds that divide both the values and their range evenly, as far
/// as they can: half of the weight goes to each, so that neither a constant background nor a few
/// outliers take all levels. Any levels give exact results; better ones leave fewer bricks to test.
///
/// The choice depends on the series only, not on the order of steps or on who has seen which: the
/// values that are looked at follow from the number of the step, and of these the ones with the
/// lowest hashes are kept.
class LevelChooser {
  public:
    /// As many values of a step are looked at where a series of steps is added.
    static constexpr std::size_t kSamplesPerStep = 1 << 11;

    explicit LevelChooser(ValueType type, std::size_t samples_per_step = kSamplesPerStep)
        : type_(type), samples_per_step_(samples_per_step) {}

    /// @param step number in the series @param stored all values of the step
    void add(std::size_t step, std::span<const std::byte> stored) {
        const std::size_t values = stored.size() / size_of(type_);
        add(step, {0, values, values}, stored);
    }
    /// Which of the values of a step: those from `first` to `end`, of `all`.
    struct Part {
        std::size_t first, end, all;
    };
    /// A part of the values of a step; what is chosen is the same however it is cut.
    void add(std::size_t step, const Part& part, std::span<const std::byte> stored);
    /// Takes over what another one of the same type has seen of other steps.
    void merge(const LevelChooser& other);
    LevelMap choose() const;
    /// Whether what it has seen so far has levels that lose nothing.
    bool lossless() const { return !many_; }

    /// All that it has seen, to be sent to another process; a few to 130,000 numbers.
    std::vector<std::uint64_t> state() const;
    /// From a `state()` of the same type.
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
    std::vector<Sample> samples_;         ///< now and then cut down to the lowest hashes
};

/// Chooses the levels for the bricks of one step alone, which depend on its values and nothing
/// else: these are added as step 0.
inline LevelChooser chooser_of_one_step(ValueType type) {
    constexpr std::size_t kSamplesOfOneStep = 1 << 14;
    return LevelChooser(type, kSamplesOfOneStep);
}

} // namespace isochron::index
