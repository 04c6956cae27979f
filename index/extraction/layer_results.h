// What was found in the layers of a step, put one behind the other as it comes.
#pragma once

#include "index/extraction/cell_set.h"

#include <chrono>
#include <cstdint>
#include <mutex>
#include <vector>

namespace isochron::index {

/// What was found in one layer.
struct LayerResult {
    /// Ids, and z of points and rows, counted from the planes below.
    CellSet cells;
    CellId first = 0;              ///< id of the first cell that ids are counted from
    std::uint32_t first_plane = 0; ///< likewise
    std::chrono::nanoseconds searching{0}, shading{0};
};

/// Layers come in any order; what came too early waits. Memory is used again, since fresh memory
/// costs more than what is put there. Thread-safe.
class LayerResults {
  public:
    /// @param set gets the cells; outlives this
    LayerResults(CellSet& set, std::uint32_t layers);

    /// An empty one, for a layer.
    LayerResult begin();
    void add(std::uint32_t layer, LayerResult result);

    /// Of all layers together; complete when all have come.
    std::chrono::nanoseconds searching{0}, shading{0};

  private:
    void append(LayerResult& result);

    CellSet& set_;
    std::mutex mutex_;
    std::vector<LayerResult> waiting_;
    std::vector<bool> came_; ///< by layer
    std::vector<LayerResult> free_;
    std::uint32_t next_ = 0; ///< the first layer that has not been appended
};

} // namespace isochron::index
