// The isosurface of a query as triangles, in plain vectors, for whoever wants to keep or export it.
//
//     const index::SurfaceMesh surface = index::mesh_of(file, {index::Instant(step), isovalue}, {.normals = true});
//     for (const auto& [a, b, c] : surface.triangles)
//         write(surface.points[a], surface.points[b], surface.points[c]);
#pragma once

#include "index/file/index_file.h"
#include "index/surface/cell_mesh.h"
#include "index/surface/cell_set.h"
#include "index/volume/query.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// What a mesh has besides its triangles.
struct MeshWishes {
    bool normals = false;
    /// Number of the array to color by (ColorSource) whose values are wanted.
    std::optional<std::size_t> values = std::nullopt;
};

/// Every cut edge of the grid has one point; CellMesh (index/surface/cell_mesh.h) says more. The
/// order is the same in every run.
struct SurfaceMesh {
    std::vector<std::array<float, 3>> points; ///< in physical space
    /// Three points each, counter-clockwise as seen from the side of lower values in index space;
    /// clockwise in physical space if the determinant of `Grid::direction` is negative.
    std::vector<std::array<std::uint32_t, 3>> triangles;
    /// If wished: of each point, of length 1, towards lower values; 0 where there is none.
    std::vector<std::array<float, 3>> normals;
    /// If wished: of each point, interpolated linearly between the ends of its edge.
    std::vector<float> values;
};

/// The surface at a step of any size: reads only what it needs.
/// @param file an index, or another of its arrays (`IndexFile::array`)
/// @throws Error: there is no such step or array of values, the file is damaged, or the index refers
///         to its sources and these have changed
SurfaceMesh mesh_of(const std::shared_ptr<const IndexFile>& file, const Query& query,
                    const MeshWishes& wishes = {});

/// Makes the meshes of many queries. Not thread-safe: keeps its work space.
class SurfaceMeshes {
  public:
    explicit SurfaceMeshes(std::shared_ptr<const IndexFile> file);
    ~SurfaceMeshes();
    SurfaceMeshes(const SurfaceMeshes&) = delete;
    SurfaceMeshes& operator=(const SurfaceMeshes&) = delete;

    /// @return nothing when stopped @throws Error as `mesh_of` does
    std::optional<SurfaceMesh> make(const Query& query, const MeshWishes& wishes = {},
                                    const std::stop_token& stop = {});
    /// Makes the mesh as it is found, a third as large. It has normals whether they are wished or
    /// not. @param cells null, or gets the cells, with points
    std::optional<CellMesh> make_packed(const Query& query, const MeshWishes& wishes = {},
                                        const std::stop_token& stop = {}, CellSet* cells = nullptr);

    /// Makes the mesh in pieces, in their order: each has the vertices that those before it do not
    /// have,
    /// and triangles whose corners are numbered through all pieces. They are in its own piece or in
    /// the one before it. A step of any size needs the memory of its cells and a few layers.
    /// @param take called by one thread at a time @return false when stopped
    bool make_pieces(const Query& query, const MeshWishes& wishes,
                     const std::function<void(CellMesh piece)>& take,
                     const std::stop_token& stop = {});
    /// The active cells alone, with points; no mesh is made. @return false when stopped
    bool find_cells(const Query& query, CellSet& cells, const std::stop_token& stop = {});

  private:
    struct WorkSpace;
    std::unique_ptr<WorkSpace> work_;
};

} // namespace isochron::index
