// Search and shading of a layer of chunks, one chunk after the other in the nearest cache.
#pragma once

#include "index/file/step_view.h"
#include "index/search/cube_cells.h"
#include "index/search/layer_candidates.h"
#include "index/surface/cell_set.h"
#include "index/volume/query.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// Keeps its work space: one for each thread. Throws as ChunkStore does.
class CubeSearch {
  public:
    /// Finds the active cells of a layer among its candidates.
    /// @param cut of the query's isovalue, see stored_cut
    /// @param shaded also makes points and rows, from all that lies around the cells
    /// @param out empty; gets ids of the whole grid, ascending, and how many cells were tested
    /// @param shading set to the time that points and rows take
    /// @param staying cells that are left out; null: none are
    void search(const StepView& step, const LayerCandidates& candidates, const Query& query,
                std::uint64_t cut, bool shaded, const std::stop_token& stop, CellSet& out,
                std::chrono::nanoseconds& shading, const StayingCells* staying = nullptr);

  private:
    /// A chunk with active cells.
    struct Found {
        std::uint32_t x, y;
        CubeRows rows;
        ChunksAround around;          ///< chunks that its cells need for normals
        std::size_t first, count = 0; ///< among all places; none until it is shaded
    };
    void find(const LayerCandidates& candidates, const Query& query, std::uint64_t cut, bool shaded,
              const std::stop_token& stop, CellSet& out);
    void shade_others(const LayerCandidates& candidates, const Query& query,
                      const std::stop_token& stop);
    void shade(Found& found, const Query& query);
    void take_places(Found& found);
    void write(bool shaded, CellSet& out);

    void need(std::uint32_t x, std::uint32_t y, ChunksAround around);
    void fetch(const LayerCandidates& candidates, const std::stop_token& stop);
    bool are_there(std::uint32_t x, std::uint32_t y, ChunksAround around) const;
    void fill_cube(std::uint32_t x, std::uint32_t y, ChunksAround around);

    const StepView* step_ = nullptr;    ///< step of the search that runs
    const ChunkGrid* chunks_ = nullptr; ///< chunks of that step
    const StayingCells* staying_ = nullptr;
    std::uint32_t layer_ = 0;
    std::chrono::nanoseconds shading_{0}; ///< time of this layer
    ChunkCube cube_;
    /// By layer (below, this, above) and place: the chunks that are there; those to fetch.
    std::array<std::vector<const Chunk*>, 3> there_;
    std::array<std::vector<std::uint32_t>, 3> missing_;
    std::vector<ChunkPtr> held_;
    std::vector<Found> found_; ///< by y, then x
    std::vector<PlaceInChunk> places_;
    std::vector<std::uint32_t> planes_;
    std::vector<RowCounts> next_; ///< counts of the chunks with the same y
};

} // namespace isochron::index
