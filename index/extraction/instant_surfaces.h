// The surfaces at one instant as triangles, not too many of them, to be shown beside those at another.
//
//     const auto then = index::instant_surfaces(file, {index::Instant(step), {isovalue}}, 100000);
//     for (const index::CellMeshPtr& mesh : then->meshes)
//         draw(*mesh);
#pragma once

#include "index/extraction/surface_colors.h"
#include "index/file/index_file.h"
#include "index/surface/cell_mesh.h"
#include "index/volume/query.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// Constant once it is made.
struct InstantSurfaces {
    SurfacesQuery query;             ///< its instant, isovalues, array and values as colors count
    std::uint64_t most = 0;          ///< triangles that all meshes together were to have at most
    std::vector<CellMeshPtr> meshes; ///< by surface, in the volume's grid; null: it has no cells
    std::uint64_t cells = 0;         ///< active cells of all surfaces, at the level of detail
    unsigned level = 0;              ///< level of detail (detail_levels.h) whose cells they are
    /// Side of the clusters that became one vertex each [cells of the volume]; 1: none did.
    std::uint32_t edge = 1;

    /// Around triangles that follow each other in a mesh, kRun of them, in even coordinates.
    struct Box {
        glm::vec3 low{0.0f}, high{0.0f};
    };
    static constexpr std::size_t kRun = 64;
    std::vector<std::vector<Box>> boxes; ///< by surface

    /// Whether the triangles are those of `mesh_of`, all of them.
    bool exact() const { return level == 0 && edge == 1; }
    std::uint64_t triangles() const;
};
using InstantSurfacesPtr = std::shared_ptr<const InstantSurfaces>;

/// The place of a vertex in even coordinates (`Grid::physical_from_index`).
glm::dvec3 even_place_of(const Grid& grid, const MeshVertex& vertex);

/// What is known of first crossings, so that further instants of the same surfaces need no search of
/// the series. Not thread-safe.
class KnownCrossings {
  public:
    /// @param file the array of the query
    SurfaceColors& of(const std::shared_ptr<const IndexFile>& file, const SurfacesQuery& query);

  private:
    struct Known {
        std::shared_ptr<const IndexFile> file;
        std::size_t surfaces = 0; ///< number of those of the query
        SurfaceColors colors;
    };
    std::list<Known> known_; ///< the one that was asked for last is the last
};

/// Makes the meshes of all isovalues of a query, without the pieces that its filter leaves out: these
/// are told apart on cells of the volume itself, so of a coarser level all are there. By coloring
/// `value` the meshes have colors, but for an array that has no values at their level; by first
/// crossings those of the volume itself have. If there are too many triangles, clusters of cells become one vertex each (mesh_clusters.h); where there are far too
/// many, a coarser level of detail is taken first, so that little is read.
/// @param file the array of the query @param known null: crossings are found for this call alone
/// @return null when stopped @throws Error as `mesh_of` and `SurfaceColors` do
InstantSurfacesPtr instant_surfaces(const std::shared_ptr<const IndexFile>& file,
                                    const SurfacesQuery& query, std::uint64_t most,
                                    const std::stop_token& stop = {},
                                    KnownCrossings* known = nullptr);

} // namespace isochron::index
