// Writes a step and its levels of detail to the file.
#pragma once

#include "index/file/chunks/chunk_codec.h"
#include "index/file/chunks/layer_packer.h"
#include "index/file/detail_levels.h"
#include "index/indexing/layer_stream.h"
#include "index/indexing/level_chooser.h"
#include "index/indexing/part_writer.h"
#include "index/indexing/plane_store.h"

#include <cstddef>
#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace isochron::index {

/// The contents of an array's chunks.
struct ChunkContents {
    bool bricks = true;
    /// Has values of the steps themselves; their levels of detail always have values.
    bool values = true;
    Codec codec = Codec::fitting;
    bool since = true;     ///< tables say since when chunks have stayed: not in files of version 3
    bool wide_rows = true; ///< packed rows for values of several bytes: not up to version 4
};

/// The resources that writing may use.
struct WriterMeans {
    unsigned threads = 1;
    std::uint64_t waiting_bytes = 64 << 20; ///< most bytes of a level's planes that wait in memory
    std::filesystem::path beside;           ///< for temporary files without a name: see ScratchFile
    /// After each step, free the memory of waiting planes, which the next array needs.
    bool lends = false;
};

/// Writes steps of one array layer by layer, each layer with all threads. Memory holds a few layers
/// of the finest level, and planes that wait for their level to be packed. Keeps its work space.
class StepWriter {
  public:
    StepWriter(const SeriesInfo& info, const ChunkContents& contents, const WriterMeans& means);

    /// Takes the next layer of the step. The last layer completes the step and its levels of
    /// detail, each at a multiple of 64.
    /// @param entries then gets one entry for each level; offsets are from the first byte of
    /// `parts`
    void take(const LayerView& layer, PartWriter& parts, std::vector<StepEntry>& entries);

    /// Sets the number of the next step that is looked at or taken.
    void begin_at(std::uint32_t step);
    /// Looks at the next layer of the step before the first one that is written, to see which
    /// chunks stay.
    void look(const LayerView& layer);
    /// For each chunk of the last step, level after level, the step since which it has stayed.
    std::vector<std::uint32_t> since() const;
    void set_since(std::span<const std::uint32_t> since);
    /// Number of chunk-steps of the finest level that were as in the step before.
    std::uint64_t stayed() const { return levels_.front().packer.stayed(); }
    /// Calls `f(begin, chunks, first)` for the table of each layer of a level: its offset from the
    /// step's first byte, its number of chunks, and where in `since` its first chunk is.
    using TablePlace =
        std::function<void(std::uint64_t begin, std::uint32_t chunks, std::size_t first)>;
    void for_each_table(std::size_t level, const StepEntry& entry, const TablePlace& f) const;
    std::size_t levels() const { return levels_.size(); }

  private:
    /// A level of detail, the step itself included.
    struct Level {
        Level(const Grid& level_grid, ValueType type, const ChunkContents& contents,
              const WriterMeans& means);

        Grid grid;
        LayerPacker packer;
        std::vector<Coarsener> coarseners; ///< by thread
        /// Chooses the levels for its bricks, if they depend on the values.
        LevelChooser chooser;
        std::optional<LevelMap> map;
        std::optional<LevelMap::Extremes> extremes; ///< extremes of the values so far
        PlaneStore waiting;                         ///< planes that cannot be packed yet
    };

    bool waits(std::size_t level) const;
    void look(Level& level, std::uint32_t first_plane, std::span<const std::byte> planes) const;
    void pack(std::size_t level, const LayerView& layer, PartWriter* parts);
    void pack_waiting(std::size_t level, PartWriter* parts);
    StepEntry finish(std::size_t level, std::uint64_t begin, PartWriter& parts);

    ValueType type_;
    ChunkContents contents_;
    unsigned threads_;
    bool lends_;
    bool own_levels_;          ///< each step's bricks have their own levels
    std::deque<Level> levels_; ///< a deque, since a Level cannot move
    std::uint64_t begin_ = 0;  ///< offset of the step in `parts`
    std::vector<std::uint8_t> bricks_;
    std::vector<std::uint64_t> coarse_; ///< planes of the next level
};

/// The entries of all members' steps, level after level.
/// @param mine this member's, step after step @param begin where its parts lie in the file
std::vector<StepEntry> agreed_steps(std::vector<StepEntry> mine, std::uint64_t begin,
                                    std::size_t levels, Team& team);

} // namespace isochron::index
