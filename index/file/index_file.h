// The .isochron file: the volume in chunks and its search structures, read as they are needed.
#pragma once

#include "index/cells/cell_tier.h"
#include "index/error.h"
#include "index/file/byte_cache.h"
#include "index/file/chunk_store.h"
#include "index/file/file_layout.h"
#include "index/file/index_contents.h"
#include "index/file/metadata.h"
#include "index/file/read_use.h"
#include "index/file/step_source.h"
#include "index/progress.h"
#include "index/system/byte_source.h"
#include "index/system/lazy_part.h"
#include "index/thi/thi_tree.h"
#include "index/volume/level_map.h"
#include "index/volume/volume_series.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::index {

/// An open index: immutable but for what it keeps of the file, thread-safe. Opening reads the
/// header, the metadata and what says where everything lies; the rest is read when it is needed,
/// and checked then. A file that is made shorter, or whose disk fails, is an Error of what needs
/// it.
class IndexFile {
  public:
    /// @param cache_bytes how much of what was read is kept; 0 for a quarter of what this process
    ///        may have
    /// @throws Error: missing, truncated, foreign, another version, damaged
    static std::shared_ptr<const IndexFile> open(const std::filesystem::path& path,
                                                 std::uint64_t cache_bytes = 0);
    static std::shared_ptr<const IndexFile> open(std::unique_ptr<ByteSource> bytes,
                                                 std::uint64_t cache_bytes = 0);
    /// Opens the newest state; when the file grows meanwhile, so that what was read belongs to
    /// different states, from the start again.
    using OpenBytes = std::function<std::unique_ptr<ByteSource>()>;
    static std::shared_ptr<const IndexFile> open_newest(const OpenBytes& open,
                                                        std::uint64_t cache_bytes = 0);

    const std::string& name() const { return bytes_->name(); }
    const SeriesInfo& info() const { return metadata_.info; }
    const IndexStats& stats() const { return metadata_.stats; }
    const TierPlan& plan() const { return metadata_.plan; }
    Codec codec() const { return metadata_.codec; }
    const LevelMap& levels() const {
        return *metadata_.levels;
    } ///< of the cells: there must be some
    const ThiOptions& tree_options() const { return metadata_.tree; }
    const std::optional<Referral>& referral() const { return metadata_.referral; }
    /// What is stored beside the values.
    const Metadata& metadata() const { return metadata_; }

    /// One step as a whole; decoded, from its source where the file refers to it: not for the
    /// thread that draws. @throws Error when it cannot be read, is damaged or is not as it was;
    /// Stopped
    LoadedStep load(std::uint32_t step, const std::stop_token& stop) const;
    LoadedStep load(std::uint32_t step) const { return load(step, {}); }
    /// Whether that is better than working on the chunks that are needed.
    bool better_whole(std::uint32_t step) const;
    /// How many levels of detail there are, the volume itself included: 0 is the finest
    /// (detail_levels.h).
    std::size_t detail_levels() const { return volume_.size(); }
    /// The volume in chunks, at a level of detail; of an index that refers to its sources those of
    /// level 0 have no values.
    const ChunkStore& chunks(std::size_t level = 0) const { return *volume_[level]; }
    /// All steps at once, decoded into memory when it is first asked for: for measurements and
    /// tests. @throws Error as `load`
    const StepValues& values() const;

    /// Null when the index carries no array to color by.
    const ColorArray* color() const { return metadata_.color ? &*metadata_.color : nullptr; }
    /// Likewise in chunks; null where the index refers to its sources.
    const ChunkStore* color_chunks(std::size_t level = 0) const {
        return colors_.empty() || (level == 0 && color_source_) ? nullptr : colors_[level].get();
    }
    /// One step of it, as `load`. There must be one.
    LoadedStep load_color(std::uint32_t step, const std::stop_token& stop) const;
    LoadedStep load_color(std::uint32_t step) const { return load_color(step, {}); }

    /// Null where the plan does without them; with the deltas, if any. They may hold the first
    /// steps only.
    const CellTier* cells() const { return cells_ ? &*cells_ : nullptr; }
    bool has_cells(std::uint32_t step) const { return cells_ && step < cells_->steps(); }
    /// Null without one. Read and checked when first asked for: not for the thread that draws.
    /// @throws Error when it is damaged
    const ThiTree* tree() const;

    /// Of the values and grid: the same data, the same hash.
    std::uint64_t content_hash() const { return header_.content_hash; }
    /// Whether that is the hash of the data, or was when the series had fewer steps: of every state
    /// that the index has grown from, and of any number of first steps up to 16,384.
    bool has_had(std::uint64_t content_hash) const;
    /// Whether it is that of so many first steps.
    bool has_had(std::uint64_t content_hash, std::size_t steps) const;
    /// What is to be said of a newer state whose header is damaged, though what it names is whole.
    std::optional<std::string> lost_state() const;
    /// Where the sections of the state before lie, which nothing names once the next is written.
    struct Room {
        std::uint64_t offset = 0, bytes = 0;
    };
    Room free_room() const;
    /// Where everything lies.
    const FileHeader& header() const { return header_; }
    std::span<const StepEntry> step_entries() const { return step_entries_; }
    std::span<const UnitEntry> directory() const { return directory_; }
    /// As stored: of the values of each step, of each unit, of the colors, and each source's state.
    std::span<const std::uint64_t> checksums() const { return checksums_; }
    /// Of the values of the array to color by.
    std::span<const std::uint64_t> color_checksums() const;
    /// What each step's source was when it was indexed; 0 where that is unknown.
    std::span<const std::uint64_t> source_states() const;
    /// What is kept of the values, and what it may take.
    ByteCache::Use cache() const { return cache_.use(); }
    /// What all that is kept of the file may take.
    std::uint64_t cache_bytes() const { return cache_bytes_; }
    /// What has been read since it was opened, and what was at hand.
    ReadUse reading() const;

    /// Compares every checksum; reads the whole file, and the sources that it refers to.
    /// @throws Error naming the damaged section
    void verify(const Progress& progress = {}) const;

  private:
    IndexFile(std::unique_ptr<ByteSource> bytes, std::uint64_t cache_bytes);

    std::size_t steps() const { return metadata_.info.steps(); }
    template <class T>
    std::vector<T> section(SectionKind kind) const;
    std::span<const std::byte> part(std::size_t unit, std::uint64_t offset,
                                    std::uint64_t bytes) const;

    void set_arrays();
    void verify_details(const Progress& progress) const;
    void set_cells();
    std::vector<std::unique_ptr<ChunkStore>> array_of(const char* called, std::size_t first,
                                                      const SeriesInfo& info);
    ChunkArray level_of(const std::string& called, std::size_t number, const SeriesInfo& info,
                        bool fine) const;
    bool lies_within(std::uint64_t offset, std::uint64_t bytes) const;
    void check_gaps() const;
    void check_step(const LoadedStep& loaded, std::uint32_t step, std::uint64_t checksum,
                    const char* called) const;
    Error damaged(const std::string& what) const;
    Error mismatch(SectionKind kind) const;

    std::unique_ptr<ByteSource> bytes_;
    std::uint64_t cache_bytes_;
    mutable ByteCache cache_;
    FileHeader header_;
    Metadata metadata_;
    std::vector<StepEntry> step_entries_;
    std::size_t details_ = 0; ///< levels of detail, the volume itself included
    std::vector<std::uint64_t> checksums_;
    std::vector<std::unique_ptr<ChunkStore>> volume_, colors_; ///< by level of detail
    std::optional<Referral> color_referral_;
    std::unique_ptr<StepSource> source_, color_source_; ///< when it refers to its sources
    std::vector<UnitEntry> directory_;
    std::vector<std::uint64_t> epoch_begins_; ///< where the units of each epoch begin
    CellTier::Pages units_;                   ///< by epoch
    std::optional<CellTier> cells_;
    mutable std::once_flag tree_read_;
    mutable std::vector<std::uint64_t> tree_bytes_;
    mutable std::unique_ptr<ThiTree> tree_;
    mutable std::once_flag all_read_;
    mutable std::shared_ptr<std::byte> all_;
    mutable StepValues values_;
};

} // namespace isochron::index
