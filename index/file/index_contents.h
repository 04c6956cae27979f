// What an .isochron file holds, as values.
#pragma once

#include "index/file/tiers.h"
#include "index/file/value_counts.h"
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

/// Everything known about a file's contents besides the values.
struct IndexStats {
    double low = 0, high = 0;             ///< range of the finite scaled values
    std::uint64_t nan_values = 0;         ///< vertex-steps that are NaN
    std::vector<std::uint64_t> histogram; ///< kHistogramBins equal bins over [low, high], all steps
    ValueCounts counts;                   ///< what these were made of
    std::uint64_t file_bytes = 0, volume_bytes = 0, bricks_bytes = 0, cells_bytes = 0,
                  deltas_bytes = 0, tree_bytes = 0, color_bytes = 0;
    std::uint64_t detail_bytes = 0; ///< of the levels of detail of volume and colors
    std::uint64_t cell_entries = 0; ///< stored (cell, extremes, time node) of the tier cells

    std::uint64_t bytes_of(Tier tier) const;
};

/// A second array of the same grid and times, which surfaces may be colored by.
struct ColorArray {
    std::string array; ///< its name, with its component
    std::string value_unit;
    ValueType type = ValueType::f32;
    Scaling scaling;
    double low = 0, high = 0; ///< range of the finite scaled values, over all steps
    std::uint64_t nan_values = 0;
    /// What picks it in the files: `ReadOptions::array` and `component`.
    std::optional<std::string> chosen_array = {}, chosen_component = {};
};

/// Where the values are when the file has no copy of them.
struct Referral {
    std::vector<std::filesystem::path> files; ///< from the folder of the index, where possible
    ReadOptions options;
};

/// One step as a whole, for as long as `owner` lives.
struct LoadedStep {
    StepValues values;                         ///< a window of this step
    std::span<const std::uint8_t> bricks = {}; ///< as from `build_bricks`; empty without bricks
    std::shared_ptr<const void> owner = nullptr;
};

} // namespace isochron::index
