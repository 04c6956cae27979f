// The .isochron file: one memory-mapped file with the volume and its search structures.
#pragma once

#include "index/cells/cell_tier.h"
#include "index/file/index_contents.h"
#include "index/thi/thi_tree.h"
#include "index/volume/level_map.h"
#include "index/volume/volume_series.h"

#include <filesystem>
#include <memory>
#include <optional>

namespace isochron::index {

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

    /// Null when the index carries no array to color by.
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
