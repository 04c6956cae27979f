// Joins parts of a mesh that were made in parallel.
#pragma once

#include "index/surface/edge_key.h"
#include "index/surface/mesh_maker.h"

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// Joins the parts of consecutive planes one after the other. Vertices on the border between two
/// parts are shared.
class PartsJoiner {
  public:
    /// Appends a part: the vertices that the part before does not have, and its triangles, whose
    /// corners are numbered through all parts.
    /// @param to what was joined so far, or an empty mesh that gets this part alone
    void add(const MeshPart& part, CellMesh& to);

    /// What a part's vertices become among those of all parts.
    struct Numbers {
        std::vector<std::uint32_t> of_first;  ///< numbers of vertices that the part before may have
        std::vector<std::uint32_t> new_first; ///< places of those that it does not have
        std::uint32_t offset;                 ///< what is added to the places of the others
        std::uint32_t count; ///< number of vertices that the part before does not have
    };
    /// Numbers the vertices of the next part.
    Numbers number(const MeshPart& part);

  private:
    /// A vertex that the next part may also have.
    struct SharedVertex {
        EdgeKey key;
        std::uint32_t number;
    };

    std::uint32_t vertices_ = 0;       ///< number of vertices of all parts
    std::vector<SharedVertex> shared_; ///< in the last plane of the part before
};

/// Joins the parts of consecutive planes, which together are all planes of a step. Vertices on the
/// border between two parts are shared.
CellMesh join_parts(std::vector<MeshPart> parts);

/// Cuts the cells of a step between planes, into parts of about the same number.
/// @param ids ascending
std::vector<std::span<const CellId>> cut_at_planes(const Grid& grid, std::span<const CellId> ids,
                                                   std::size_t parts);

/// The mesh of a step's active cells, with as many threads as there are makers.
/// @return false when it was stopped and the mesh is incomplete
bool make_mesh(std::span<MeshMaker> makers, const StepValues& values, const Query& query,
               std::span<const CellId> ids, CellMesh& mesh, const std::stop_token& stop = {});

} // namespace isochron::index
