// One step of an array, or a moment between two, as work on it asks for it: its grid, type and
// scaling, and its values whole or in chunks.
//
//     const index::StepView step = index::step_of(*file, query.instant);
//     index::LayerSearch(file).search(step, set, true, true, {}); // whole or in chunks
#pragma once

#include "index/file/between_steps.h"
#include "index/file/chunks/chunk_store.h"
#include "index/file/index_file.h"
#include "index/volume/instant.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// Whether the work is on the whole step or on its chunks is decided when the view is made, and
/// stays so, whatever is read meanwhile. Between two steps, type, scaling, levels and values are
/// those of their blend (index/volume/blend.h). Functions that read throw as ChunkStore does.
class StepView {
  public:
    /// What there is to know of a step before it is read.
    struct Kind {
        const Grid* grid;
        ValueType type;
        Scaling scaling;
        std::size_t steps; ///< steps of the series
    };
    using Load = std::function<LoadedStep(std::uint32_t step, const std::stop_token& stop)>;
    /// By chunks. @param store of the array at a level of detail; outlives the view
    /// @param isovalues that values will be compared with; empty: any may be. Between two steps,
    ///        values for some isovalues are smaller and sooner made (Blend)
    StepView(const ChunkStore& store, Instant at, std::size_t level = 0,
             std::span<const double> isovalues = {});
    /// As a whole. @param store null if there are no chunks @param load reads the whole step
    StepView(const Kind& kind, const ChunkStore* store, Instant at, Load load,
             std::span<const double> isovalues = {});

    Instant at() const { return at_; }
    bool between() const { return at_.between(); }
    const Grid& grid() const { return *kind_.grid; }
    ValueType type() const { return kind_.type; }
    const Scaling& scaling() const { return kind_.scaling; }
    std::size_t steps() const { return kind_.steps; }
    std::size_t level() const { return level_; } ///< level of detail
    /// The stored value at which `scaled >= isovalue` changes (index/volume/stored_cut.h).
    std::optional<std::uint64_t> stored_cut(double isovalue) const;

    bool by_chunks() const { return !load_; }
    /// All of a step that is not worked on by chunks: read when it is first needed, since that may
    /// decode a file. Call it first from one thread. @throws Stopped as well
    const LoadedStep& whole(const std::stop_token& stop) const;

    const ChunkGrid& chunk_grid() const { return store_->grid(); }
    /// The levels whose ranks its bricks hold, which the index must have.
    /// Of a small step that is worked on as a whole they come with all else, in one request.
    LevelMapPtr levels() const;
    /// The isovalue among these levels; none if no cell is active.
    std::optional<LevelMap::Cut> cut(double isovalue) const {
        return levels()->cut(scaling(), isovalue);
    }
    ChunkLayerPtr layer(std::uint32_t layer) const {
        return between_ ? between_->layer(layer) : store_->layer(at_.step, layer);
    }
    /// Chunks of a layer; where the step is worked on as a whole, they are cut out of it.
    std::vector<ChunkPtr> chunks(std::uint32_t layer, std::span<const std::uint32_t> places,
                                 const std::stop_token& stop) const {
        if (!by_chunks())
            return cut_out(layer, places, stop);
        return between_ ? between_->chunks(layer, places, stop)
                        : store_->chunks(at_.step, layer, places, stop);
    }
    /// What a ChunkCube takes, by chunks: between two steps, pairs of chunks, of which the cube
    /// blends what it needs.
    std::vector<ChunkPtr> cube_chunks(std::uint32_t layer, std::span<const std::uint32_t> places,
                                      const std::stop_token& stop) const {
        return between_ ? between_->pairs(layer, places, stop)
                        : store_->chunks(at_.step, layer, places, stop);
    }
    /// The blend of these pairs; null at a step.
    const Blend* cube_blend() const { return between_ ? &*blend_ : nullptr; }
    /// As of ChunkStore.
    std::uint64_t expect(std::uint32_t first,
                         std::span<const std::vector<std::uint32_t>> places) const {
        if (!by_chunks())
            return 0;
        return between_ ? between_->expect(first, places) : store_->expect(at_.step, first, places);
    }
    std::uint64_t fetch(std::uint32_t layer, std::span<const std::uint32_t> places,
                        const std::stop_token& stop) const {
        if (!by_chunks())
            return 0;
        return between_ ? between_->fetch(layer, places, stop)
                        : store_->fetch(at_.step, layer, places, stop);
    }
    /// Between two steps, none is read for it alone.
    bool was_worked_on() const { return between_ || store_->was_worked_on(at_.step); }
    const ChunkStore& store() const { return *store_; }
    /// By chunks between two steps, these steps; else null.
    const BetweenSteps* between_steps() const { return by_chunks() ? between_.get() : nullptr; }

  private:
    void set_between(std::span<const double> isovalues);
    std::vector<ChunkPtr> cut_out(std::uint32_t layer, std::span<const std::uint32_t> places,
                                  const std::stop_token& stop) const;

    Kind kind_;
    const ChunkStore* store_;
    Instant at_;
    std::size_t level_ = 0;
    std::optional<Blend> blend_;                  ///< between two steps
    std::shared_ptr<const BetweenSteps> between_; ///< null at a step, and without chunks
    Load load_;
    mutable std::optional<LoadedStep> whole_;
};

/// A step of the volume: whole where that is faster than work on the needed chunks alone.
/// @param file outlives the view @param isovalues as of StepView
StepView step_of(const IndexFile& file, Instant at, std::span<const double> isovalues = {});
/// The step for work on a part of its cells: by chunks unless it is in memory as a whole.
StepView part_of_step(const IndexFile& file, Instant at);
/// By chunks, at a level of detail.
StepView step_in_chunks(const IndexFile& file, Instant at, std::size_t level = 0,
                        std::span<const double> isovalues = {});

} // namespace isochron::index
