// Makes the triangles of the cells in some planes of a step.
#pragma once

#include "index/surface/cell_mesh.h"
#include "index/volume/query.h"
#include "index/volume/step_values.h"

#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// The mesh of the cells in some planes of a step; its vertices are numbered from 0.
using MeshPart = CellMesh;

/// The mesh of an earlier set, some of whose cells are as they were.
struct EarlierMesh {
    static constexpr std::uint32_t kNone = ~0u;
    const CellMesh* mesh = nullptr;
    /// Of each cell of the earlier set: where its corners begin among the mesh's `triangles`.
    std::span<const std::uint32_t> corners;
    /// Of each cell of the new set: its place in the earlier one, or kNone.
    std::span<const std::uint32_t> places;

    EarlierMesh part(std::size_t first, std::size_t count) const {
        return {mesh, corners, mesh ? places.subspan(first, count) : places};
    }
    bool has(std::size_t cell) const { return mesh && places[cell] != kNone; }
};
/// `EarlierMesh::corners` of a mesh.
std::vector<std::uint32_t> corners_of_cells(const CellMesh& mesh);

/// Makes meshes of cells; keeps its work space. One for each thread.
class MeshMaker {
  public:
    /// @param values with the neighbors of the cells that normals need
    /// @param ids active cells of `values`, ascending
    /// @param first_plane added to the z of vertices
    /// @param earlier has triangles and vertices of some cells, around which no values are needed
    /// @return false when it was stopped and the part is incomplete
    bool make(const StepValues& values, const Query& query, std::span<const CellId> ids,
              MeshPart& part, std::uint32_t first_plane = 0, const std::stop_token& stop = {},
              const EarlierMesh& earlier = {});

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
    void find_cases_of(const StepValues& values, const Query& query, std::uint64_t cut,
                       std::span<const CellId> ids, const EarlierMesh& earlier,
                       std::span<std::uint8_t> cases);
    void place_new(const StepValues& values, const Query& query, std::uint32_t first_plane,
                   std::span<MeshVertex> vertices);
    Tables tables_;
    // Of the cells of a plane that the earlier mesh does not have:
    std::vector<CellId> ids_;
    std::vector<std::uint8_t> cases_;
    std::vector<std::uint32_t> numbers_; ///< of their vertices
    std::vector<MeshVertex> vertices_;
};

} // namespace isochron::index
