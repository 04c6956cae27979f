// The .isochron file: the volume in chunks and its search structures, read when they are needed.
#pragma once

#include "index/error.h"
#include "index/file/chunks/byte_cache.h"
#include "index/file/chunks/chunk_store.h"
#include "index/file/read_use.h"
#include "index/file/sections/file_layout.h"
#include "index/file/sections/index_contents.h"
#include "index/file/sections/metadata.h"
#include "index/file/step_source.h"
#include "index/progress.h"
#include "index/system/byte_source.h"
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
#include <string_view>
#include <utility>
#include <vector>

namespace isochron::index {

/// An open index: immutable except for its cache, thread-safe. One of several arrays of a file is
/// an index of its own, which shares the file and its cache with the others. Opening reads the
/// header, the metadata and the offsets of all parts; other parts are read, and checked, when they
/// are needed. If the file becomes shorter or its disk fails, the function that needs a part throws
/// Error.
class IndexFile {
  public:
    /// @param cache_bytes size of the cache; 0 for a quarter of the memory this process may have
    /// @throws Error: missing, truncated, foreign, another version, damaged
    static std::shared_ptr<const IndexFile> open(const std::filesystem::path& path,
                                                 std::uint64_t cache_bytes = 0);
    static std::shared_ptr<const IndexFile> open(std::unique_ptr<ByteSource> bytes,
                                                 std::uint64_t cache_bytes = 0);

    /// Number of arrays of the file that have search structures.
    std::size_t arrays() const { return first().further_.size() + 1; }
    /// One of them, whichever this is. @param number from 0, below `arrays()`
    const IndexFile& array(std::size_t number) const {
        return number == 0 ? first() : *first().further_[number - 1];
    }
    /// The number of the array with this name (`SeriesInfo::array`), if there is one.
    std::optional<std::size_t> array_called(std::string_view name) const;

    const std::string& name() const { return bytes_->name(); }
    /// All bytes of the file.
    const ByteSource& bytes() const { return *bytes_; }
    /// That the file is damaged, for whoever makes sense of its parts.
    Error damaged(const std::string& what) const;
    const SeriesInfo& info() const { return metadata_.info; }
    const IndexStats& stats() const { return metadata_.stats; }
    const ChosenTiers& plan() const { return metadata_.plan; }
    Codec codec() const { return metadata_.codec; }
    const ThiOptions& tree_options() const { return metadata_.tree; }
    const std::optional<Referral>& referral() const { return metadata_.referral; }
    /// The whole metadata section.
    const Metadata& metadata() const { return metadata_; }

    /// Reads and decodes one whole step, from its source if the file refers to that. Slow: do not
    /// call it on the render thread. @throws Error when it cannot be read, is damaged or has
    /// changed since the build; Stopped
    LoadedStep load(std::uint32_t step, const std::stop_token& stop) const;
    LoadedStep load(std::uint32_t step) const { return load(step, {}); }
    /// Whether that is faster than work on the needed chunks alone.
    bool better_whole(std::uint32_t step) const;
    /// Number of levels of detail, the volume itself (level 0, the finest) included
    /// (detail_levels.h).
    std::size_t detail_levels() const { return volume_.size(); }
    /// The chunks of the volume at a level of detail. In an index that refers to its sources,
    /// chunks of level 0 have no values.
    const ChunkStore& chunks(std::size_t level = 0) const { return *volume_[level]; }
    /// All steps, decoded into memory at the first call: for measurements and tests. @throws Error
    /// as `load`
    const StepValues& values() const;

    /// The array to color by; null if the index has none.
    const ColorArray* color() const { return metadata_.color ? &*metadata_.color : nullptr; }
    /// Its chunks at a level of detail; null if there is no such array, and at level 0 if the index
    /// refers to its sources.
    const ChunkStore* color_chunks(std::size_t level = 0) const {
        return colors_.empty() || (level == 0 && color_source_) ? nullptr : colors_[level].get();
    }
    /// One step of the array to color by, which the index must have; see `load`.
    LoadedStep load_color(std::uint32_t step, const std::stop_token& stop) const;
    LoadedStep load_color(std::uint32_t step) const { return load_color(step, {}); }

    bool has_tree() const { return header_.section(SectionKind::tree).bytes > 0; }
    /// The bytes of the THI tree (index/search/tree_of_file.h opens it). Reads them, and checks the
    /// checksum. @throws Error when they are damaged
    std::vector<std::uint64_t> tree_bytes() const;

    /// Hash of values, grid and times: the same data give the same hash.
    std::uint64_t content_hash() const { return header_.content_hash; }
    /// The header that counts, with the offsets of all sections.
    const FileHeader& header() const { return header_; }
    /// Whether its tables say since when chunks have stayed.
    bool has_since() const { return header_.version > kVersionWithoutSince; }
    /// Whether new steps may have values of several bytes in packed rows.
    bool has_wide_rows() const { return header_.version > kVersionWithoutWideRows; }
    std::span<const StepEntry> step_entries() const { return step_entries_; }
    /// Parts that an earlier program wrote, of tiers that no search uses any more.
    std::span<const UnusedParts> unused() const { return unused_; }
    /// The section `checksums` as stored: of the values of each step, of each unused part, of the
    /// array to color by, and the state of each step's source.
    std::span<const std::uint64_t> checksums() const { return checksums_; }
    /// The part for the array to color by.
    std::span<const std::uint64_t> color_checksums() const;
    /// The state of each step's source when it was indexed; 0 if unknown.
    std::span<const std::uint64_t> source_states() const;
    /// Where the parts of all arrays lie, and how many bytes they have.
    using Parts = std::vector<std::pair<std::uint64_t, std::uint64_t>>;
    Parts parts() const;
    /// Keeps what is made of the file's parts, within the budget of the values.
    ByteCache& kept() const { return *cache_; }
    /// Use and budget of the cache of values.
    ByteCache::Use cache() const { return cache_->use(); }
    /// The budget [bytes] of everything that is kept of the file.
    std::uint64_t cache_bytes() const { return cache_bytes_; }
    /// What has been read since the file was opened, and what the cache had.
    ReadUse reading() const;

    /// Checks every checksum: reads the whole file, and the sources that it refers to.
    /// @throws Error naming the damaged section
    void verify(const Progress& progress = {}) const;

  private:
    IndexFile(std::unique_ptr<ByteSource> bytes, std::uint64_t cache_bytes);
    IndexFile(const IndexFile& first, const ArrayPlace& place);

    const IndexFile& first() const { return first_ ? *first_ : *this; }
    void read();
    void open_further();
    void expect_same_shape(const IndexFile& first) const;
    std::size_t steps() const { return metadata_.info.steps(); }
    template <class T>
    std::vector<T> section(SectionKind kind) const;

    void set_arrays();
    void check_unused();
    std::vector<std::unique_ptr<ChunkStore>> array_of(const char* called, std::size_t first,
                                                      const SeriesInfo& info);
    ChunkArray level_of(const std::string& called, std::size_t number, const SeriesInfo& info,
                        bool fine) const;
    bool lies_within(std::uint64_t offset, std::uint64_t bytes) const;
    Error mismatch(SectionKind kind) const;

    const IndexFile* first_ = nullptr; ///< the first array of the file; null: this is it
    std::shared_ptr<ByteSource> bytes_;
    std::uint64_t cache_bytes_;
    std::shared_ptr<ByteCache> cache_;
    FileHeader header_;
    Metadata metadata_;
    std::uint32_t number_ = 0; ///< number of the array
    std::vector<StepEntry> step_entries_;
    std::size_t details_ = 0; ///< levels of detail, the volume itself included
    std::vector<std::uint64_t> checksums_;
    std::vector<std::unique_ptr<ChunkStore>> volume_, colors_; ///< by level of detail
    std::optional<Referral> color_referral_;
    std::unique_ptr<StepSource> source_, color_source_; ///< if it refers to its sources
    std::vector<UnusedParts> unused_;
    /// Guards what `values` reads when it is first asked for; after a failure the next caller tries
    /// again.
    mutable std::mutex reading_;
    mutable std::shared_ptr<std::byte> all_;
    mutable StepValues values_;
    std::vector<std::unique_ptr<IndexFile>> further_; ///< the other arrays, of the first one only
};

/// One array of a file that stays open as long as this.
/// @param number as `IndexFile::array` takes it
inline std::shared_ptr<const IndexFile> array_of(const std::shared_ptr<const IndexFile>& file,
                                                 std::size_t number) {
    return {file, &file->array(number)};
}

/// Opens the newest state. If the file grows meanwhile, so that the parts that were read belong to
/// different states, starts again. @throws Error as `IndexFile::open` does
using OpenBytes = std::function<std::unique_ptr<ByteSource>()>;
std::shared_ptr<const IndexFile> open_newest(const OpenBytes& open, std::uint64_t cache_bytes = 0);

/// Checks every checksum of all arrays: reads the whole file, and the sources that it refers to. What
/// `IndexFile::verify` does.
/// @throws Error naming the damaged section
void check_index(const IndexFile& file, const Progress& progress);

} // namespace isochron::index
