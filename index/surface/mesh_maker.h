// Makes the triangles of the cells in some planes of a step.
#pragma once

#include "index/surface/cell_mesh.h"
#include "index/volume/query.h"
#include "index/volume/step_values.h"

#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>

namespace isochron::index {

/// The mesh of the cells in some planes of a step; its vertices are numbered from 0.
using MeshPart = CellMesh;

/// Makes meshes of cells; keeps its work space. One for each thread.
class MeshMaker {
  public:
    /// @param values with the neighbors of the cells that normals need
    /// @param ids active cells of `values`, ascending
    /// @param first_plane added to the z of vertices
    /// @return false when it was stopped and the part is incomplete
    bool make(const StepValues& values, const Query& query, std::span<const CellId> ids,
              MeshPart& part, std::uint32_t first_plane = 0, const std::stop_token& stop = {});

  private:
    /// The vertex of each edge of a plane of cells, if the edge has one: edges along x and y on
    /// both sides of the plane, and along z.
    struct Tables {
        void fit(const Grid& grid, std::size_t cells);
        std::size_t size = 0;
        std::uint32_t base = 1; ///< number of the next mesh's first vertex
        std::unique_ptr<std::uint32_t[]> numbers;
    };
    class Pass;
    Tables tables_;
};

} // namespace isochron::index
