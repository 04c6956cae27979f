// The surface of one step as measures ask for it; what several of them need is made once.
#pragma once

#include "index/file/index_file.h"
#include "index/measure/mesh_pieces.h"
#include "index/measure/vertex_sides.h"
#include "index/surface/cell_mesh.h"
#include "index/surface/mesh_crop.h"
#include "index/volume/grid.h"
#include "index/volume/query.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// Not thread-safe. Functions throw Error and Stopped as StepView does.
class MeasuredStep {
  public:
    /// @param mesh of all active cells @param box measures its cells alone, as a grid of their own;
    ///        none: all @param complete see `pieces_of` @param stop, file, mesh outlive this
    MeasuredStep(const IndexFile& file, const Query& query, const CellMesh& mesh,
                 const std::optional<VertexBox>& box, bool complete, const std::stop_token& stop);

    /// In the box.
    const CellMesh& mesh() const { return box_ ? cropped_ : whole_; }
    const Grid& grid() const { return grid_; }
    std::size_t triangles() const { return mesh().triangles.size() / 3; }
    /// Places of the vertices in physical space, less the grid's origin.
    const std::vector<glm::dvec3>& points();
    /// Half the cross product of two sides of each triangle: its normal, towards lower values if
    /// `Grid::direction` has a positive determinant, as long as its area.
    const std::vector<glm::dvec3>& normals();
    const std::vector<double>& areas();
    const MeshPieces& pieces();
    const VertexSides& sides();
    /// Volumes of the cells that no surface cuts, and the parts of those that it does.
    struct Volumes {
        double above = 0, below = 0;
    };
    const Volumes& volumes();
    /// Connected sets of vertices above, by six neighbors.
    std::uint64_t bodies();

  private:
    bool corner_is_above() const;

    const IndexFile& file_;
    const Query& query_;
    const CellMesh& whole_;
    CellMesh cropped_;
    std::optional<VertexBox> box_;
    Grid grid_;
    bool complete_;
    const std::stop_token& stop_;
    std::optional<std::vector<glm::dvec3>> points_, normals_;
    std::optional<std::vector<double>> areas_;
    std::optional<MeshPieces> pieces_;
    std::optional<VertexSides> sides_;
    std::optional<Volumes> volumes_;
};

} // namespace isochron::index
