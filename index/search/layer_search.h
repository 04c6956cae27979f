// Searches a step part by part with all cores: finds and tests active cells, and makes their
// planes, meshes and colors. Only the chunks that are needed are read.
#pragma once

#include "index/file/color_source.h"
#include "index/file/index_file.h"
#include "index/file/step_view.h"
#include "index/search/layer_candidates.h"
#include "index/search/layer_results.h"
#include "index/search/layer_work.h"
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

/// What the vertices of a mesh get from an array to color by: color coordinates, or its values.
struct VertexColors {
    const ColorSource* source = nullptr; ///< null: nothing; else as of LayerSearch::color_cells
    bool as_values = false;
};

/// A part is a layer of chunks or, where StepView has the step as a whole, some or all of its
/// planes. By chunks, the index must carry its values. Functions throw Error as ChunkStore does. A
/// function that was stopped returns false or throws Stopped, and its results are incomplete. Not
/// thread-safe: keeps its work space.
class LayerSearch {
  public:
    explicit LayerSearch(std::shared_ptr<const IndexFile> file) : work_(std::move(file)) {}

    /// Finds the active cells of `set.query`, ascending.
    /// @param by_bricks search with bricks, which the index must have; else by a scan
    /// @param shaded also make points and rows, while each part is in memory
    /// @param only with bricks and by chunks: search these chunks alone
    bool search(const StepView& step, CellSet& set, bool by_bricks, bool shaded,
                const std::stop_token& stop, const ChunkFilter& only = {});
    /// Searches by bricks, without the cells that stay.
    bool search_others(const StepView& step, CellSet& set, const StayingCells& staying, bool shaded,
                       const std::stop_token& stop);
    /// The number of active cells, without keeping the cells; empty when stopped.
    std::optional<std::uint64_t> count(const StepView& step, const Query& query, bool by_bricks,
                                       const std::stop_token& stop);
    /// @param ids ascending
    bool keep_active(const StepView& step, const Query& query, std::vector<CellId>& ids,
                     const std::stop_token& stop);
    /// Adds points and rows to the cells of a set.
    bool shade_cells(const StepView& step, CellSet& set, const std::stop_token& stop);
    /// @param set in the order of `search`; with points, if the grid has wide ids
    /// @param earlier has the mesh of some cells; with colors if the mesh gets some by `colors`
    bool make_mesh(const StepView& step, const CellSet& set, CellMesh& mesh,
                   const std::stop_token& stop, const VertexColors& colors = {},
                   const EarlierMesh& earlier = {});
    /// Makes the mesh in pieces, in their order, as PartsJoiner numbers them: by chunks the memory
    /// of a few layers is enough. @param take called by one thread at a time, while the others wait
    bool make_mesh_pieces(const StepView& step, const CellSet& set,
                          const std::function<void(CellMesh piece)>& take,
                          const std::stop_token& stop, const VertexColors& colors = {});
    /// @param set as above @param source by chunks, has chunks at the step's level of detail
    /// @param corners eight for each cell (color_corners); empty: they are not wanted
    bool color_cells(const StepView& step, const CellSet& set, const ColorSource& source,
                     std::span<std::uint16_t> out, const std::stop_token& stop,
                     std::span<std::uint16_t> corners = {});

  private:
    /// Cells in the order of `search`, with points where ids are wide.
    struct Cells {
        std::span<const CellId> ids;
        std::span<const CellPoint> points = {};
        const EarlierMesh* earlier = nullptr; ///< cells that it has need no values
    };
    /// Some of these cells, with the values around them.
    struct CellsOfPart {
        StepValues values;
        CellId first = 0;              ///< id in the step of cell 0 of `values`
        std::uint32_t first_plane = 0; ///< z in the step of plane 0 of `values`
        std::span<const CellId> ids;   ///< counted from `first`, ascending
        std::size_t before = 0;        ///< cells of the parts before this one
        std::size_t number = 0;        ///< number of the part
        unsigned worker = 0;
        std::uint32_t layer = 0; ///< by chunks
    };
    using Work = std::function<void(const CellsOfPart& part)>;

    static std::size_t parts(const StepView& step, const Cells& cells, unsigned most);
    static std::vector<CellId> without_earlier(const Cells& cells, std::span<const CellId> some);
    bool for_each_part(const StepView& step, const Cells& cells, bool normals, unsigned most,
                       const Work& work, const std::stop_token& stop);
    using TakePart = std::function<void(std::size_t number, MeshPart part)>;
    bool make_parts(const StepView& step, const Cells& cells, const Query& query,
                    const TakePart& take, const std::stop_token& stop, const VertexColors& colors);
    static void color(const StepView& other, const VertexColors& colors, const CellsOfPart& part,
                      const EarlierMesh& earlier, std::span<const std::uint32_t> uncolored,
                      MeshPart& made, const std::stop_token& stop);
    static StepValues around(const StepView& other, std::uint32_t layer,
                             std::span<const CellId> ids, StepSlab& slab,
                             const std::stop_token& stop);
    std::span<const CellId> of_layer(const StepView& step, const Cells& cells,
                                     std::uint32_t layer) const;

    LayerWork work_;
    std::vector<MeshMaker> makers_; ///< by worker
};

/// The active cells at a level of detail, ascending, with ids in the level's own grid. If these do
/// not fit a CellId, the cells have points, too. In an index that refers to its sources, only from
/// level 1 on.
/// @throws Error: there is no such level or step, damaged
CellSet search_level(const std::shared_ptr<const IndexFile>& file, std::size_t level,
                     const Query& query);

} // namespace isochron::index
