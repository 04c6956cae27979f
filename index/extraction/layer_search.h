// Search, test and shading of a step by its chunks: all cores, layer by layer, reading little.
#pragma once

#include "index/extraction/cell_set.h"
#include "index/extraction/layer_results.h"
#include "index/extraction/mesh_maker.h"
#include "index/extraction/step_slab.h"
#include "index/file/index_file.h"
#include "index/volume/query.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// Does what the functions of the same names do with a whole step, of an index that carries its
/// values. Every function throws Error as ChunkStore does, and gives false when it was stopped and
/// the results are incomplete. Not thread-safe: keeps its work space.
class LayerSearch {
  public:
    /// @param level of detail; colors are those of level 0
    explicit LayerSearch(std::shared_ptr<const IndexFile> file, std::size_t level = 0);

    /// Finds the active cells of `set.query`, ascending.
    /// @param by_bricks needs an index that has them; else by a scan
    /// @param shaded whether they get points and rows too, each layer while it is at hand
    bool search(CellSet& set, bool by_bricks, bool shaded, const std::stop_token& stop);
    /// @param ids ascending
    bool keep_active(const Query& query, std::vector<CellId>& ids, const std::stop_token& stop);
    bool shade_cells(CellSet& set, const std::stop_token& stop);
    /// @param ids active cells, ascending
    bool make_mesh(const Query& query, std::span<const CellId> ids, CellMesh& mesh,
                   const std::stop_token& stop);
    /// With the array to color by, which the index must carry.
    bool color_cells(const Query& query, std::span<const CellId> cells,
                     std::span<std::uint16_t> out, const std::stop_token& stop);

  private:
    using Work = std::function<void(StepSlab& slab, std::uint32_t layer)>;
    static void shade(StepSlab& slab, const Query& query, LayerResult& result,
                      const std::stop_token& stop);
    /// Ascending, of a layer.
    using PlacesOf = std::function<std::vector<std::uint32_t>(std::uint32_t layer)>;
    bool for_each_layer(std::uint32_t step, const PlacesOf& places, const Work& work,
                        const std::stop_token& stop);
    bool for_each_layer_of(std::uint32_t step, std::span<const CellId> cells, const Work& work,
                           const std::stop_token& stop);
    std::span<const CellId> of_layer(std::span<const CellId> ids, std::uint32_t layer) const;

    std::shared_ptr<const IndexFile> file_;
    const ChunkStore& store_;
    std::vector<std::unique_ptr<StepSlab>> slabs_; ///< by thread
    std::vector<MeshMaker> makers_;                ///< likewise
};

/// The active cells at a level of detail, ascending; ids are those of the level's own grid, and where
/// they do not fit a CellId the cells have their points, too. Of an index that refers to its sources
/// from level 1 on.
/// @throws Error: there is no such level or step, damaged
CellSet search_level(const std::shared_ptr<const IndexFile>& file, std::size_t level,
                     const Query& query);

} // namespace isochron::index
