// The surface of one step as measures ask for it; what several of them need is made once.
#pragma once

#include "index/file/index_file.h"
#include "index/measure/mesh_pieces.h"
#include "index/measure/plane_cut.h"
#include "index/measure/vertex_sides.h"
#include "index/surface/cell_mesh.h"
#include "index/surface/mesh_crop.h"
#include "index/volume/grid.h"
#include "index/volume/query.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// Not thread-safe. Functions throw Error and Stopped as StepView does.
class MeasuredStep {
  public:
    /// @param mesh of all active cells @param box measures its cells alone, as a grid of their own;
    ///        none: all @param clip measures what this plane leaves; none: all
    /// @param kept measures these pieces alone
    /// @param complete see `pieces_of` @param stop, file, mesh outlive this
    MeasuredStep(const IndexFile& file, const Query& query, const CellMesh& mesh,
                 const std::optional<VertexBox>& box, const std::optional<CutPlane>& clip,
                 const PieceFilter& kept, bool complete, const std::stop_token& stop);

    bool has_all_pieces() const { return all_pieces_; }
    /// This step with all pieces of the surface, uncut.
    MeasuredStep with_all_pieces() const {
        return {file_, query_, whole_, box_, {}, {}, complete_, stop_};
    }
    bool is_cut() const { return clip_.has_value(); }
    /// Sets the place, in physical space, to which distances are measured; none: they are undefined.
    void measure_from(const std::optional<glm::dvec3>& place) { from_ = place; }
    const std::optional<glm::dvec3>& from() const { return from_; }

    const Grid& grid() const { return grid_; }
    /// Cells of which a part is on the surface.
    std::uint64_t cells() const { return clip_ ? cut_.triangles.size() : mesh().cases.size(); }
    std::uint64_t vertices() const { return clip_ ? cut_.vertices : mesh().vertices.size(); }
    /// Three points for each triangle.
    std::span<const std::uint32_t> corners() const {
        return clip_ ? std::span<const std::uint32_t>(cut_.corners) : mesh().triangles;
    }
    std::size_t triangles() const { return corners().size() / 3; }
    /// The other array's at the points; empty without one.
    std::span<const float> values() const { return clip_ ? cut_.values : mesh().values; }
    /// In physical space, less the grid's origin. Those that no triangle has may be among them.
    const std::vector<glm::dvec3>& points();
    /// Half the cross product of two sides of each triangle: its normal, towards lower values if
    /// `Grid::direction` has a positive determinant, as long as its area.
    const std::vector<glm::dvec3>& normals();
    const std::vector<double>& areas();
    const MeshPieces& pieces();
    /// Cells that have a triangle of each piece.
    std::vector<std::uint32_t> cells_of_pieces();
    /// Vertices that are cut away are on no side.
    const VertexSides& sides();
    /// Volumes of the cells that no surface cuts, and the parts of those that it does.
    struct Volumes {
        double above = 0, below = 0;
    };
    const Volumes& volumes();
    /// Connected sets of vertices above, by six neighbors; like volumes and sides, with all pieces of
    /// the surface.
    std::uint64_t bodies();

  private:
    /// In the box, uncut: of all pieces, and of kept ones.
    const CellMesh& mesh_of_all() const { return cropped_ ? *cropped_ : whole_; }
    const CellMesh& mesh() const { return part_ ? *part_ : mesh_of_all(); }
    std::vector<glm::dvec3> points_of_mesh() const;
    void cut_surface();
    bool corner_is_above() const;

    const IndexFile& file_;
    const Query& query_;
    const CellMesh& whole_;
    std::optional<CellMesh> cropped_, part_; ///< in the box, and of kept pieces
    std::optional<VertexBox> box_;
    Grid grid_;
    std::optional<PlaneCut> clip_;
    CutSurface cut_; ///< what the plane leaves of the mesh
    std::optional<glm::dvec3> from_;
    bool complete_, all_pieces_;
    const std::stop_token& stop_;
    std::optional<std::vector<glm::dvec3>> points_, normals_;
    std::optional<std::vector<double>> areas_;
    std::optional<MeshPieces> pieces_;
    std::optional<VertexSides> uncut_, sides_;
    std::optional<Volumes> volumes_;
};

} // namespace isochron::index
