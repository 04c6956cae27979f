// Makes triangles of the cells in some planes of a step.
#pragma once

#include "index/extraction/cell_mesh.h"
#include "index/volume/query.h"
#include "index/volume/step_values.h"

#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>

namespace isochron::index {

/// The mesh of the cells in some planes of a step, whose vertices are counted from 0.
using MeshPart = CellMesh;

/// Makes meshes of cells; keeps its work space. One for each thread.
class MeshMaker {
  public:
    /// @param values with what the cells' normals need around them
    /// @param ids active cells of `values`, ascending
    /// @param first_plane what is added to the z of vertices
    /// @return false when it was stopped and the part is incomplete
    bool make(const StepValues& values, const Query& query, std::span<const CellId> ids,
              MeshPart& part, std::uint32_t first_plane = 0, const std::stop_token& stop = {});

  private:
    /// For each edge of a plane, along x and y at both its sides and along z, a vertex that it may
    /// have.
    struct Tables {
        void fit(const Grid& grid, std::size_t cells);
        std::size_t size = 0;
        std::uint32_t base = 1; ///< that the next mesh counts its vertices from
        std::unique_ptr<std::uint32_t[]> numbers;
    };
    class Pass;
    Tables tables_;
};

} // namespace isochron::index
