// Search, test and shading of a step by its chunks: layer by layer, with all cores, reading only
// the chunks that are needed.
#pragma once

#include "index/file/color_source.h"
#include "index/file/index_file.h"
#include "index/search/cube_search.h"
#include "index/search/layer_results.h"
#include "index/search/step_slab.h"
#include "index/surface/cell_set.h"
#include "index/surface/mesh_maker.h"
#include "index/volume/query.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// Does with chunks what the functions of the same names do with a whole step. The index must carry
/// its values. Functions throw Error as ChunkStore does, and return false when they were stopped
/// and the results are incomplete. Not thread-safe: keeps its work space.
class LayerSearch {
  public:
    /// @param level of detail
    explicit LayerSearch(std::shared_ptr<const IndexFile> file, std::size_t level = 0);

    /// Finds the active cells of `set.query`, ascending.
    /// @param by_bricks search with bricks, which the index must have; else by a scan
    /// @param shaded also make points and rows, while each layer is in memory
    /// @param only with bricks: search these chunks alone
    bool search(CellSet& set, bool by_bricks, bool shaded, const std::stop_token& stop,
                const ChunkFilter& only = {});
    /// The number of active cells, none of which is kept; empty when stopped.
    std::optional<std::uint64_t> count(const Query& query, bool by_bricks,
                                       const std::stop_token& stop);
    /// @param ids ascending
    bool keep_active(const Query& query, std::vector<CellId>& ids, const std::stop_token& stop);
    bool shade_cells(CellSet& set, const std::stop_token& stop);
    /// @param set in the order of `search`; with points, if the grid has wide ids
    bool make_mesh(const CellSet& set, CellMesh& mesh, const std::stop_token& stop);
    /// @param set as above @param source has chunks at this level
    bool color_cells(const CellSet& set, const ColorSource& source, std::span<std::uint16_t> out,
                     const std::stop_token& stop);

  private:
    bool run(const Query& query, bool by_bricks, bool shaded, const std::stop_token& stop,
             const ChunkFilter& only, LayerResults& results);
    unsigned threads() const { return static_cast<unsigned>(slabs_.size()); }
    using Work = std::function<void(StepSlab& slab, std::uint32_t layer)>;
    using WorkOfThread = std::function<void(unsigned thread, std::uint32_t layer)>;
    StepSlab& slab(unsigned thread);
    /// Called for a layer some layers before the work on it; may be empty.
    using Prepare = std::function<void(std::uint32_t layer)>;
    static void shade(StepSlab& slab, const Query& query, LayerResult& result,
                      const std::stop_token& stop);
    /// Gives the places of the chunks of a layer, ascending.
    using PlacesOf = std::function<std::vector<std::uint32_t>(std::uint32_t layer)>;
    bool for_each_layer(std::uint32_t step, const PlacesOf& places, const Prepare& prepare,
                        const WorkOfThread& work, const std::stop_token& stop);
    /// Cells in the order of `search`, with points where ids are wide.
    struct Cells {
        std::span<const CellId> ids;
        std::span<const CellPoint> points = {};
    };
    bool for_each_layer_of(std::uint32_t step, const Cells& cells, const Work& work,
                           const std::stop_token& stop);
    CellId first_of(std::uint32_t layer) const;
    std::span<const CellId> of_layer(const Cells& cells, std::uint32_t layer) const;

    std::shared_ptr<const IndexFile> file_;
    const std::size_t level_;
    const ChunkStore& store_;
    std::vector<std::unique_ptr<StepSlab>> slabs_;   ///< by thread
    std::vector<std::unique_ptr<CubeSearch>> cubes_; ///< by thread
    std::vector<MeshMaker> makers_;                  ///< by thread
};

/// The active cells at a level of detail, ascending, with ids in the level's own grid. If these do
/// not fit a CellId, the cells have points, too. In an index that refers to its sources, only from
/// level 1 on.
/// @throws Error: there is no such level or step, damaged
CellSet search_level(const std::shared_ptr<const IndexFile>& file, std::size_t level,
                     const Query& query);

} // namespace isochron::index
