// The contents of an .isochron file besides the volume, as structures.
#pragma once

#include "index/file/sections/tiers.h"
#include "index/file/sections/value_counts.h"
#include "index/volume/step_values.h"
#include "index/volume/volume_series.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::index {

/// Statistics of a file's values, and the sizes of its parts.
struct IndexStats {
    double low = 0, high = 0;             ///< range of the finite scaled values
    std::uint64_t nan_values = 0;         ///< vertex-steps that are NaN
    std::vector<std::uint64_t> histogram; ///< kHistogramBins equal bins over [low, high], all steps
    ValueCounts counts;                   ///< from which range and histogram follow
    std::uint64_t file_bytes = 0, volume_bytes = 0, bricks_bytes = 0, tree_bytes = 0,
                  color_bytes = 0;
    std::uint64_t unused_bytes = 0; ///< tiers of earlier programs (UnusedParts)
    std::uint64_t detail_bytes = 0; ///< levels of detail of the volume and the array to color by
    std::uint64_t staying = 0;      ///< chunks of all steps that are as in the step before

    std::uint64_t bytes_of(Tier tier) const {
        return tier == Tier::bricks ? bricks_bytes : tree_bytes;
    }
};

/// A second array with the same grid and times, by which surfaces can be colored.
struct ColorArray {
    std::string array; ///< its name, with its component
    std::string value_unit;
    ValueType type = ValueType::f32;
    Scaling scaling;
    double low = 0, high = 0; ///< range of the finite scaled values, over all steps
    std::uint64_t nan_values = 0;
    /// The options that select it in the files: `ReadOptions::array` and `component`.
    std::optional<std::string> chosen_array = {}, chosen_component = {};
};

/// Where to read the values if the file has no copy of them.
struct Referral {
    std::vector<std::filesystem::path> files; ///< relative to the index's folder if possible
    ReadOptions options;
};

/// One whole step, valid as long as `owner` lives.
struct LoadedStep {
    StepValues values;                         ///< a window of this step only
    std::span<const std::uint8_t> bricks = {}; ///< as from `build_bricks`; empty without bricks
    std::shared_ptr<const void> owner = nullptr;
};

} // namespace isochron::index
