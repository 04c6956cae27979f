// The .isochron file: one memory-mapped file with the volume and its search structures.
#pragma once

#include "index/cell_tier.h"
#include "index/level_map.h"
#include "index/step_values.h"
#include "index/thi_tree.h"
#include "index/tiers.h"
#include "index/volume_series.h"

#include <filesystem>
#include <memory>
#include <optional>

namespace isochron::index {

constexpr std::size_t kHistogramBins = 256;

/// Everything known about a file's contents besides the values.
struct IndexStats {
    double low = 0, high = 0;             ///< range of the finite scaled values
    std::uint64_t nan_values = 0;         ///< vertex-steps that are NaN
    std::vector<std::uint64_t> histogram; ///< kHistogramBins equal bins over [low, high], all steps
    std::uint64_t file_bytes = 0, volume_bytes = 0, bricks_bytes = 0, cells_bytes = 0,
                  deltas_bytes = 0, tree_bytes = 0, color_bytes = 0;
    std::uint64_t cell_entries = 0; ///< stored (cell, extremes, time node) of the tier cells

    std::uint64_t bytes_of(Tier tier) const;
};

/// A second array of the same grid and times, which surfaces may be coloured by.
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

/// The values of one step, for as long as `owner` lives.
struct LoadedStep {
    StepValues values; ///< a window of this step
    std::shared_ptr<const void> owner;
};

/// An open index: immutable, thread-safe, owns the mapping. Opening checks the header, the
/// metadata and the directory of parts and touches nothing else; `verify` checks the rest. A mapped
/// file that is made shorter, or whose disk fails, ends the program with SIGBUS.
class IndexFile {
  public:
    /// @throws Error: missing, truncated, foreign, another version, damaged
    static std::shared_ptr<const IndexFile> open(const std::filesystem::path& path);
    virtual ~IndexFile() = default;

    virtual const SeriesInfo& info() const = 0;
    virtual const IndexStats& stats() const = 0;
    virtual const TierPlan& plan() const = 0;
    virtual const LevelMap& levels() const = 0; ///< of bricks and cells
    virtual const ThiOptions& tree_options() const = 0;

    /// All steps. @throws Error when the file refers to its sources instead of carrying a copy
    virtual const StepValues& values() const = 0;
    virtual const std::optional<Referral>& referral() const = 0;
    /// One step; decoded from its source where the file refers to it: not for the thread that
    /// draws. @throws Error when a source cannot be read or is not as it was
    virtual LoadedStep load(std::uint32_t step) const = 0;

    /// Null when the index carries no array to colour by.
    virtual const ColorArray* color() const = 0;
    /// One step of it, as `load`. There must be one.
    virtual LoadedStep load_color(std::uint32_t step) const = 0;

    // Null or empty where the plan does without them.
    virtual std::span<const std::uint8_t> bricks(std::uint32_t step) const = 0;
    virtual const CellTier* cells() const = 0; ///< with the deltas, if any
    /// Checked when first asked for, which reads the whole tree: not for the thread that draws.
    /// @throws Error when it is damaged
    virtual const ThiTree* tree() const = 0;

    virtual std::uint64_t
    content_hash() const = 0; ///< of the values and grid: the same data, the same hash

    /// Compares every checksum; reads the whole file, and the sources that it refers to.
    /// @throws Error naming the damaged section
    virtual void verify(const Progress& progress = {}) const = 0;
};

} // namespace isochron::index
