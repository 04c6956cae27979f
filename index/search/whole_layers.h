// Slabs of neighboring layers, for searches that need most of them: each chunk is decoded once,
// straight to its place, and kept nowhere else.
#pragma once

#include "index/file/chunks/record_stream.h"
#include "index/search/step_slab.h"
#include "index/volume/level_map.h"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// Goes once through the layers of a step that may hold active cells. A layer is handed over once
/// it and its neighbors are decoded. Functions throw as ChunkStore does.
class WholeLayers {
  public:
    /// The layers of a step to go through.
    struct Range {
        std::uint32_t first = 0, end = 0;
    };
    /// Whether going through whole layers is worth it, if nothing of the step is in memory: most
    /// layers are fetched whole anyhow, and the slabs take at most half of `room` bytes.
    /// @return the layers from the first to the last that may hold active cells
    static std::optional<Range> worth(const StepView& step, const LevelMap::Cut& cut,
                                      unsigned threads, std::uint64_t room);

    /// @param step outlives this
    WholeLayers(const StepView& step, Range range, const LevelMap::Cut& cut, unsigned threads);

    /// Called from `threads` threads, for layers in about their order. All of the slab is filled,
    /// with the bricks that may hold active cells.
    /// @param decoding time that it took all threads together to decode the layer
    using Work =
        std::function<void(StepSlab& slab, std::uint32_t layer, std::chrono::nanoseconds decoding)>;
    /// @return false when stopped
    bool for_each(const Work& work, const std::stop_token& stop);

  private:
    struct Layer {
        std::uint32_t pieces = 0; ///< not yet decoded
        std::uint32_t uses = 0;   ///< by work on this layer and on its neighbors, still to come
        bool begun = false, worked_on = false;
        std::chrono::nanoseconds decoding{0};
    };

    void run(RecordStream& stream, const Work& work, const std::stop_token& stop);
    StepSlab* begin(const RecordPiece& piece, const std::stop_token& stop);
    void decode(const RecordPiece& piece, StepSlab& slab);
    std::vector<std::uint32_t> finish(const RecordPiece& piece, std::chrono::nanoseconds time);
    void release(std::uint32_t layer);
    Layer& of(std::uint32_t layer) { return layers_[layer - decoded_.first]; }
    StepSlab& slab(std::uint32_t layer) { return *slabs_[layer % slabs_.size()]; }

    const StepView& step_;
    const Range worked_on_, decoded_;
    const LevelMap::Cut cut_;
    const unsigned threads_;
    std::mutex mutex_; ///< for the members below
    std::condition_variable released_;
    bool failed_ = false;
    std::vector<Layer> layers_; ///< the decoded ones
    std::vector<std::unique_ptr<StepSlab>> slabs_;
};

} // namespace isochron::index
