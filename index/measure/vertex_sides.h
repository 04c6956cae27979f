// On which side of an isosurface the vertices of a step lie, as runs along x.
//
//     const auto sides = index::VertexSides::of_mesh(mesh, grid, false);
//     for (const auto& [begin, end] : sides.above(y, z))
//         count += end - begin; // vertices of this row whose value is at least the isovalue
#pragma once

#include "index/file/step_view.h"
#include "index/measure/plane_cut.h"
#include "index/surface/cell_mesh.h"
#include "index/surface/mesh_crop.h"
#include "index/volume/grid.h"
#include "index/volume/query.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// A vertex is above the isosurface if its value is at least the isovalue, below it if its value is
/// less, and on neither side if its value is missing (NaN; between two steps also infinite).
class VertexSides {
  public:
    /// Vertices of a row: x from `begin` to before `end`.
    struct Run {
        std::uint32_t begin = 0, end = 0;
        bool operator==(const Run&) const = default;
    };

    /// Follows the cut edges; reads no values.
    /// @param mesh of all active cells of a step in which no value is missing
    /// @param all_above the side of all vertices if the mesh is empty
    static VertexSides of_mesh(const CellMesh& mesh, const Grid& grid, bool all_above);
    /// Reads all values of the step. @throws Error, Stopped as StepView does
    static VertexSides of_values(const StepView& step, double isovalue,
                                 const std::stop_token& stop);

    /// Runs of the row of vertices at y and z that are above; ascending, not adjacent.
    std::span<const Run> above(std::uint32_t y, std::uint32_t z) const {
        return runs(above_, row(y, z));
    }
    /// Those below.
    std::span<const Run> below(std::uint32_t y, std::uint32_t z) const {
        return runs(below_, row(y, z));
    }
    const Grid& grid() const { return grid_; }
    /// Those in a box of vertices, seen for themselves: they count from 0.
    /// @param part the grid of the box
    VertexSides within(const VertexBox& box, const Grid& part) const;

    /// Those that a plane leaves; the others are on neither side.
    VertexSides left_by(const PlaneCut& plane) const;

    bool operator==(const VertexSides&) const = default;

  private:
    /// The runs of all rows, row after row, and where each row ends.
    struct Rows {
        std::vector<Run> runs;
        std::vector<std::uint32_t> ends;
        bool operator==(const Rows&) const = default;
    };
    class OfMesh;

    explicit VertexSides(const Grid& grid);
    std::size_t row(std::uint32_t y, std::uint32_t z) const {
        return std::size_t{z} * grid_.vertices[1] + y;
    }
    static std::span<const Run> runs(const Rows& rows, std::size_t row) {
        const std::size_t begin = row == 0 ? 0 : rows.ends[row - 1];
        return std::span(rows.runs).subspan(begin, rows.ends[row] - begin);
    }
    template <class T>
    void add_row(const T* values, T least, bool upper_is_above);
    void end_row();

    Grid grid_;
    Rows above_, below_;
};

/// The place of a cell of a mesh: the coordinates of its lowest vertex.
/// @param first_vertex the first corner of its first triangle @param of_cell its case
std::array<std::uint32_t, 3> cell_of_mesh(const MeshVertex& first_vertex, std::uint8_t of_cell);

} // namespace isochron::index
