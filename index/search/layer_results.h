// Joins the results of a step's layers, in the order of the layers.
#pragma once

#include "index/surface/cell_set.h"

#include <chrono>
#include <cstdint>
#include <mutex>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// The results of one layer.
struct LayerResult {
    /// Its ids are counted from `first`, the z of its points and rows from `first_plane`.
    CellSet cells;
    CellId first = 0;              ///< id in the grid of the cell with id 0 here
    std::uint32_t first_plane = 0; ///< z in the grid of plane 0 here
    std::chrono::nanoseconds searching{0}, shading{0};
};

/// Layers may arrive in any order; a result that arrives early waits. Memory is used again, since
/// fresh memory costs more time than filling it. Thread-safe.
class LayerResults {
  public:
    /// @param set gets the cells; outlives this
    /// @param stop once it is requested, cells are no longer kept
    LayerResults(CellSet& set, std::uint32_t layers, std::stop_token stop);
    /// Counts cells and does not keep them.
    explicit LayerResults(std::uint32_t layers);

    /// An empty result, to be filled for a layer.
    LayerResult begin();
    void add(std::uint32_t layer, LayerResult result);

    /// Times of all layers together; complete once all have been added.
    std::chrono::nanoseconds searching{0}, shading{0};
    std::uint64_t cells = 0;

  private:
    void append(LayerResult& result);
    void keep(LayerResult& result);

    CellSet* set_; ///< null to count only
    const std::stop_token stop_;
    std::mutex mutex_;
    std::vector<LayerResult> waiting_;
    std::vector<bool> came_; ///< by layer
    std::vector<LayerResult> free_;
    std::uint32_t next_ = 0; ///< the first layer that has not been appended
};

} // namespace isochron::index
