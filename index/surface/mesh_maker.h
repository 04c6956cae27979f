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

/// Where in a mesh each of its cells begins, and at last where the last one ends.
struct CellsOfMesh {
    std::vector<std::uint32_t> corners;  ///< among its `triangles`
    std::vector<std::uint32_t> vertices; ///< the vertices that no cell before has
};
CellsOfMesh cells_of(const CellMesh& mesh);

/// The mesh of an earlier set, some of whose cells are as they were.
struct EarlierMesh {
    static constexpr std::uint32_t kNone = ~0u;
    const CellMesh* mesh = nullptr;
    const CellsOfMesh* cells = nullptr; ///< cells of the mesh
    /// The place of each cell of the new set in the earlier one, or kNone.
    std::span<const std::uint32_t> places;
    /// Whether each cell of the new set and all that share an edge with it, in either set, are as
    /// they were; empty: unknown.
    std::span<const std::uint8_t> inner = {};
    /// `places` without the cells whose vertices may have other colors; empty: the new mesh has none.
    std::span<const std::uint32_t> colored = {};

    EarlierMesh part(std::size_t first, std::size_t count) const {
        const auto some = [&](auto all) { return all.empty() ? all : all.subspan(first, count); };
        return {mesh, cells, some(places), some(inner), some(colored)};
    }
    bool has(std::size_t cell) const { return mesh && places[cell] != kNone; }
    bool has_colors() const { return !colored.empty(); }
    bool has_colors_of(std::size_t cell) const { return colored[cell] != kNone; }
};
/// Makes meshes of cells; keeps its work space. One for each thread.
class MeshMaker {
  public:
    /// @param values with the neighbors of the cells that normals need
    /// @param ids active cells of `values`, ascending
    /// @param first_plane added to the z of vertices
    /// @param earlier has triangles and vertices of some cells, around which no values are needed;
    ///        if it has colors, the part gets those that stay, and room for the others
    /// @return false when it was stopped and the part is incomplete
    bool make(const StepValues& values, const Query& query, std::span<const CellId> ids,
              MeshPart& part, std::uint32_t first_plane = 0, const std::stop_token& stop = {},
              const EarlierMesh& earlier = {});
    /// If the earlier mesh has colors: vertices of the last part that did not get theirs from there,
    /// ascending.
    std::span<const std::uint32_t> uncolored() const { return uncolored_; }

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
    void finish_cell(const EarlierMesh& earlier, std::size_t cell, std::uint32_t first,
                     std::uint32_t end, std::span<const std::uint32_t> corners, MeshPart& part);
    void color_run(const EarlierMesh& earlier, std::size_t cell, std::uint32_t first,
                   std::uint32_t end, MeshPart& part);
    void place_new(const StepValues& values, const Query& query, std::uint32_t first_plane,
                   std::span<MeshVertex> vertices);
    Tables tables_;
    // What is known about the cells of a plane that the earlier mesh does not have:
    std::vector<CellId> ids_;
    std::vector<std::uint8_t> cases_;
    std::vector<std::uint32_t> numbers_; ///< numbers of their vertices
    std::vector<std::uint32_t> uncolored_;
    /// The number of each vertex of the earlier mesh plus Tables::base; less than that: it has
    /// none.
    std::vector<std::uint32_t> renumbered_;
    std::vector<MeshVertex> vertices_;
};

} // namespace isochron::index
