// The .isochron file: one memory-mapped file with the volume and its search structures.
#pragma once

#include "index/cells/cell_tier.h"
#include "index/error.h"
#include "index/file/color_array.h"
#include "index/file/file_layout.h"
#include "index/file/index_contents.h"
#include "index/file/metadata.h"
#include "index/file/step_source.h"
#include "index/system/mapped_file.h"
#include "index/thi/thi_tree.h"
#include "index/volume/level_map.h"
#include "index/volume/volume_series.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>

namespace isochron::index {

/// An open index: immutable, thread-safe, owns the mapping. Opening checks the header, the
/// metadata and the directory of parts and touches nothing else; `verify` checks the rest. A mapped
/// file that is made shorter, or whose disk fails, ends the program with SIGBUS.
class IndexFile {
  public:
    /// @throws Error: missing, truncated, foreign, another version, damaged
    static std::shared_ptr<const IndexFile> open(const std::filesystem::path& path);

    const SeriesInfo& info() const { return metadata_.info; }
    const IndexStats& stats() const { return metadata_.stats; }
    const TierPlan& plan() const { return metadata_.plan; }
    const LevelMap& levels() const { return *metadata_.levels; } ///< of bricks and cells
    const ThiOptions& tree_options() const { return metadata_.tree; }

    /// All steps. @throws Error when the file refers to its sources instead of carrying a copy
    const StepValues& values() const;
    const std::optional<Referral>& referral() const { return metadata_.referral; }
    /// One step; decoded from its source where the file refers to it: not for the thread that
    /// draws. @throws Error when a source cannot be read or is not as it was
    LoadedStep load(std::uint32_t step) const;

    /// Null when the index carries no array to color by.
    const ColorArray* color() const { return metadata_.color ? &*metadata_.color : nullptr; }
    /// One step of it, as `load`. There must be one.
    LoadedStep load_color(std::uint32_t step) const { return colors_->load(step); }

    // Null or empty where the plan does without them.
    std::span<const std::uint8_t> bricks(std::uint32_t step) const;
    const CellTier* cells() const {
        return cells_ ? &*cells_ : nullptr;
    } ///< with the deltas, if any
    /// Checked when first asked for, which reads the whole tree: not for the thread that draws.
    /// @throws Error when it is damaged
    const ThiTree* tree() const;

    /// Of the values and grid: the same data, the same hash.
    std::uint64_t content_hash() const { return header_.content_hash; }

    /// Compares every checksum; reads the whole file, and the sources that it refers to.
    /// @throws Error naming the damaged section
    void verify(const Progress& progress = {}) const;

  private:
    explicit IndexFile(const std::filesystem::path& path);

    std::size_t steps() const { return metadata_.info.steps(); }
    std::span<const std::byte> section(SectionKind kind) const;
    std::span<const std::byte> part(std::uint64_t offset, std::uint64_t bytes) const;
    std::span<const std::uint64_t> checksums() const;

    void set_values();
    void set_bricks();
    void set_cells();
    void set_colors(const std::filesystem::path& path);
    void check(SectionKind kind) const;
    void check_gaps() const;
    Error damaged(const std::string& what) const;
    Error mismatch(SectionKind kind) const;

    std::string name_;
    MappedFile file_;
    FileHeader header_;
    Metadata metadata_;
    StepValues values_; ///< unless it refers to its sources
    std::unique_ptr<StepSource> source_;
    std::unique_ptr<ColorSection> colors_;
    std::uint64_t brick_bytes_ = 0, brick_stride_ = 0;
    std::span<const UnitEntry> directory_;
    std::optional<CellTier> cells_;
    std::uint64_t checksum_count_ = 0;
    mutable std::once_flag tree_checked_;
    mutable std::unique_ptr<ThiTree> tree_;
};

} // namespace isochron::index
