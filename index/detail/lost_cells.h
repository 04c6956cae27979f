// Active cells of a volume where coarser levels of detail have none: specks, thin sheets and bulges
// that are lost in the means of these levels.
#pragma once

#include "index/detail/detail_regions.h"
#include "index/search/layer_search.h"
#include "index/surface/cell_set.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <stop_token>

namespace isochron::index {

/// An active cell of the finest level that an index has is lost if its region has a coarser level,
/// and no drawn cell reaches into the cell of that coarser level around it.
class LostCells {
  public:
    /// About the most chunks that are read. If more chunks may hold lost cells, only those are read in
    /// which nothing at all is drawn; and if these are still too many, they are thinned.
    static constexpr std::size_t kMostChunks = std::size_t{1} << 14;

    /// @param finest level that the index has chunks of
    /// @param search of that level, with bricks; all outlive this
    LostCells(const IndexFile& file, const DetailRegions& regions, unsigned finest,
              LayerSearch& search, std::size_t most_chunks = kMostChunks)
        : file_(file), regions_(regions), finest_(finest), search_(search),
          most_chunks_(most_chunks) {}

    /// @param drawn the cells of the query's surface in a picture, at places of mixed levels
    /// @param levels of the regions in that picture
    /// @param found gets ids and points of the finest level's grid, ascending
    /// @return false when stopped
    /// @throws Error as ChunkStore does
    bool find(const Query& query, std::span<const CellPoint> drawn,
              std::span<const std::uint8_t> levels, CellSet& found, const std::stop_token& stop);

  private:
    const IndexFile& file_;
    const DetailRegions& regions_;
    unsigned finest_;
    LayerSearch& search_;
    std::size_t most_chunks_;
};

} // namespace isochron::index
