// The chunks of a layer that may hold active cells. They are read before the layer is searched, and
// the disk is told about the chunks around them.
#pragma once

#include "index/file/step_view.h"
#include "index/search/brick_reach.h"
#include "index/search/chunk_reach.h"
#include "index/search/staying_cells.h"
#include "index/volume/level_map.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <stop_token>
#include <utility>
#include <vector>

namespace isochron::index {

/// Whether a chunk, given by its layer and its place, is to be searched; empty: all are.
using ChunkFilter = std::function<bool(std::uint32_t layer, std::uint32_t place)>;

/// Functions that read throw as ChunkStore does.
class LayerCandidates {
  public:
    LayerCandidates() = default;
    /// Reads the candidates, and announces the chunks around them that a search and normals will
    /// need. If these chunks were read one by one when needed, each would wait behind all earlier
    /// requests to the disk.
    /// @param normals whether normals will be made, too
    /// @param only reads the candidates among these alone
    /// @param staying cells that are known already, whose bricks are left out; null: none are
    LayerCandidates(const StepView& step, std::uint32_t layer, const LevelMap::Cut& cut,
                    bool normals, const std::stop_token& stop, const ChunkFilter& only = {},
                    const StayingCells* staying = nullptr);

    /// The chunks that may hold active cells according to their ranks, ascending.
    static std::vector<std::uint32_t> places_of(const ChunkLayer& table, const LevelMap::Cut& cut,
                                                std::uint32_t layer = 0,
                                                const ChunkFilter& only = {});
    /// The number of these chunks.
    static std::size_t count_of(const ChunkLayer& table, const LevelMap::Cut& cut,
                                std::uint32_t layer = 0, const ChunkFilter& only = {});
    /// Whether cells with ranks from `low` to `high` may be active.
    static bool may_hold(std::uint8_t low, std::uint8_t high, const LevelMap::Cut& cut) {
        return cut.may_hold(low, high);
    }
    /// The bricks of a chunk that hold the cells at these places.
    static BricksOfChunk bricks_at(SidesOfCells sides);

    std::uint32_t layer() const { return layer_; }
    /// The places of candidates, ascending.
    const std::vector<std::uint32_t>& places() const { return places_; }
    const ChunkPtr& chunk(std::size_t i) const { return chunks_[i]; }
    /// The bricks of a chunk that may hold active cells.
    BricksOfChunk bricks(std::size_t i) const { return bricks_[i]; }
    /// The chunks that hold vertices of the cells of these bricks, the chunk itself included.
    ChunksAround reach(std::size_t i) const;
    /// Time that reading the candidates took.
    std::chrono::nanoseconds time() const { return time_; }
    /// Removes what has been announced from the `places` of this layer or of one next to it.
    void keep_unannounced(std::uint32_t layer, std::vector<std::uint32_t>& places) const;

  private:
    std::uint32_t layer_ = 0;
    std::vector<std::uint32_t> places_;
    std::vector<ChunkPtr> chunks_;
    std::vector<BricksOfChunk> bricks_;
    std::array<std::vector<std::uint32_t>, 3> around_; ///< announced: below, this layer, above
    std::array<ChunkLayerPtr, 3> tables_;              ///< null where there is no layer
    LevelMap::Cut cut_{};
    std::chrono::nanoseconds time_{0};
};

/// The candidates of layers, each read once by whoever comes first. Thread-safe.
class PreparedCandidates {
  public:
    using Read = std::function<LayerCandidates(std::uint32_t layer)>;
    PreparedCandidates(std::uint32_t layers, Read read) : read_(std::move(read)), of_(layers) {}

    void prepare(std::uint32_t layer);
    /// Prepares the layer, or waits for the thread that does. Call it once for each layer.
    LayerCandidates take(std::uint32_t layer);

  private:
    struct Layer {
        std::mutex mutex;
        bool there = false;
        LayerCandidates candidates;
    };
    Read read_;
    std::vector<Layer> of_;
};

} // namespace isochron::index
