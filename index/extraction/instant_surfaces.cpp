// Makes the triangles of an instant's surfaces, and simplifies them where there are too many.
#include "index/extraction/instant_surfaces.h"

#include "index/file/color_source.h"
#include "index/file/step_view.h"
#include "index/measure/kept_pieces.h"
#include "index/search/index_search.h"
#include "index/search/layer_search.h"
#include "index/search/surface_mesh.h"
#include "index/surface/mesh_clusters.h"
#include "index/surface/mesh_colors.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

namespace isochron::index {
namespace {

using Box = InstantSurfaces::Box;

constexpr std::uint64_t kTrianglesOfCell = 2; ///< on average
/// Cells of a surface for each cell that it has at the next coarser level.
constexpr std::uint64_t kFinerCells = 4;
/// How many more triangles than are wanted are made and then simplified: that is truer than a coarser
/// level.
constexpr std::uint64_t kMadeForOne = 16;

std::uint64_t triangles_of(const std::vector<CellMesh>& meshes) {
    return std::accumulate(
        meshes.begin(), meshes.end(), std::uint64_t{0},
        [](std::uint64_t sum, const CellMesh& mesh) { return sum + mesh.triangles.size() / 3; });
}

/// A vertex of a level of detail, in the grid of the volume.
MeshVertex in_volume(MeshVertex vertex, const Grid& volume, unsigned level) {
    const auto at = [&](int axis, std::uint32_t number) {
        return std::min(number << level, volume.vertices[static_cast<std::size_t>(axis)] - 1);
    };
    const int axis = vertex.axis;
    const std::array<std::uint32_t, 3> low{vertex.x, vertex.y, vertex.z};
    const std::uint32_t number = low[vertex.axis];
    const double from = volume.distance(axis, at(axis, number)),
                 to = volume.distance(axis, at(axis, number + 1));
    const double share = static_cast<double>(vertex.share) / MeshVertex::kWhole;
    const double place = volume.index_at(axis, from + share * (to - from));
    std::array<std::uint32_t, 3> moved{at(0, low[0]), at(1, low[1]), at(2, low[2])};
    const double first = std::clamp(std::floor(place), 0.0, volume.vertices[vertex.axis] - 2.0);
    moved[vertex.axis] = static_cast<std::uint32_t>(first);
    vertex.x = static_cast<std::uint16_t>(moved[0]);
    vertex.y = static_cast<std::uint16_t>(moved[1]);
    vertex.z = static_cast<std::uint16_t>(moved[2]);
    vertex.share =
        static_cast<std::uint32_t>(std::clamp(place - first, 0.0, 1.0) * MeshVertex::kWhole);
    return vertex;
}

/// Makes the meshes of one query, surface after surface.
class InstantMeshes {
  public:
    InstantMeshes(const std::shared_ptr<const IndexFile>& file, const SurfacesQuery& query,
                  const std::stop_token& stop)
        : file_(file), query_(query), stop_(stop),
          by_bricks_(file->plan().tiers.has(Tier::bricks)) {
        if (query.coloring == CellColoring::value && query.colors < ColorSource::count(*file))
            colors_.emplace(*file, query.colors);
    }

    /// The finest level that is expected to have not too many triangles to make: counted from the
    /// coarsest. @return nothing when stopped
    std::optional<unsigned> finest(std::uint64_t most) {
        step_of_query(*file_, query_.instant); // which the series must have
        if (kTrianglesOfCell * file_->info().grid.cell_count() * query_.isovalues.size() <= most)
            return 0;
        for (auto level = static_cast<unsigned>(file_->detail_levels() - 1); level > 0; --level) {
            const auto cells = count(level);
            if (!cells)
                return std::nullopt;
            if (kTrianglesOfCell * kFinerCells * *cells > most)
                return level;
        }
        return 0;
    }

    /// @return false when stopped
    bool make(unsigned level, std::vector<CellMesh>& meshes, KnownCrossings& known) {
        SurfaceMeshes of_volume(file_);
        const bool by_crossing = by_first_crossing(query_.coloring) && level == 0;
        std::vector<CellSet> cells(query_.isovalues.size());
        for (std::size_t i = 0; i < query_.isovalues.size(); ++i) {
            CellMesh& mesh = meshes.emplace_back();
            if (!std::isfinite(query_.isovalues[i]))
                continue;
            if (level > 0 && !make_of_level(query_.surface(i), level, mesh))
                return false;
            if (level > 0)
                continue;
            MeshWishes wishes;
            if (colors_)
                wishes.values = query_.colors;
            auto made = of_volume.make_packed(query_.surface(i), wishes, stop_,
                                              by_crossing ? &cells[i] : nullptr);
            if (!made)
                return false;
            mesh = std::move(*made);
            if (colors_)
                color_by_values(mesh, colors_->array().low, colors_->array().high);
        }
        return !by_crossing || color_by_crossings(cells, meshes, known);
    }

  private:
    bool color_by_crossings(const std::vector<CellSet>& cells, std::vector<CellMesh>& meshes,
                            KnownCrossings& known) {
        std::vector<std::uint16_t> colors, corners;
        if (!known.of(file_, query_).fill(query_, cells, step(0), colors, corners, stop_))
            return false;
        std::span<const std::uint16_t> rest = colors;
        for (std::size_t i = 0; i < meshes.size() && !rest.empty(); ++i) {
            color_by_cells(meshes[i], rest.first(cells[i].ids.size()));
            rest = rest.subspan(cells[i].ids.size());
        }
        return true;
    }

    StepView step(unsigned level) const { return step_in_chunks(*file_, query_.instant, level); }

    std::optional<std::uint64_t> count(unsigned level) {
        LayerSearch search(file_);
        std::uint64_t cells = 0;
        for (std::size_t i = 0; i < query_.isovalues.size(); ++i) {
            if (!std::isfinite(query_.isovalues[i]))
                continue;
            const auto some = search.count(step(level), query_.surface(i), by_bricks_, stop_);
            if (!some)
                return std::nullopt;
            cells += *some;
        }
        return cells;
    }

    /// An array that an index only refers to has no coarser levels.
    VertexColors colors_of_level(unsigned level) const {
        return {colors_ && colors_->chunks(level) ? &*colors_ : nullptr, false};
    }

    bool make_of_level(const Query& query, unsigned level, CellMesh& mesh) {
        LayerSearch search(file_);
        CellSet cells;
        cells.query = query;
        const StepView at = step(level);
        if (!search.search(at, cells, by_bricks_, has_wide_ids(at.grid()), stop_) ||
            !search.make_mesh(at, cells, mesh, stop_, colors_of_level(level)))
            return false;
        for (MeshVertex& vertex : mesh.vertices)
            vertex = in_volume(vertex, file_->info().grid, level);
        return true;
    }

    const std::shared_ptr<const IndexFile>& file_;
    const SurfacesQuery& query_;
    const std::stop_token& stop_;
    bool by_bricks_;
    std::optional<ColorSource> colors_;
};

/// Clusters as small as may be with which there are not too many triangles.
/// @return their edge [cells]; 0 when stopped
std::uint32_t simplify(std::vector<CellMesh>& meshes, std::uint64_t most, unsigned level,
                       const std::stop_token& stop) {
    const std::uint64_t all = triangles_of(meshes);
    if (all <= most)
        return 1;
    constexpr std::uint32_t kLargest = 1 << 16;
    const double times =
        static_cast<double>(all) / static_cast<double>(std::max<std::uint64_t>(most, 1));
    // A surface of clusters of n cells along each side has about n^2 times fewer triangles.
    for (auto edge = std::max(2u, std::bit_floor(static_cast<std::uint32_t>(std::sqrt(times))));;
         edge *= 2) {
        std::vector<CellMesh> fewer;
        for (const CellMesh& mesh : meshes)
            fewer.push_back(clustered(mesh, edge << level, stop));
        if (stop.stop_requested())
            return 0;
        if (triangles_of(fewer) <= most || edge >= kLargest) {
            meshes = std::move(fewer);
            return edge << level;
        }
    }
}

std::vector<Box> boxes_of(const CellMesh& mesh, const Grid& grid) {
    constexpr float kAround = 1e-3f; // more than numbers are rounded
    constexpr std::size_t kCorners = 3 * InstantSurfaces::kRun;
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::vec3 at(even_place_of(grid, mesh.vertices[mesh.triangles[i]]));
        if (i % kCorners == 0)
            boxes.push_back({at - kAround, at + kAround});
        boxes.back() = {glm::min(boxes.back().low, at - kAround),
                        glm::max(boxes.back().high, at + kAround)};
    }
    return boxes;
}

} // namespace

glm::dvec3 even_place_of(const Grid& grid, const MeshVertex& vertex) {
    glm::dvec3 at = position_of(vertex);
    for (int axis = 0; axis < 3 && grid.rectilinear(); ++axis)
        at[axis] = grid.distance(axis, at[axis]) / grid.spacing[axis];
    return at;
}

std::uint64_t InstantSurfaces::triangles() const {
    std::uint64_t sum = 0;
    for (const CellMeshPtr& mesh : meshes)
        sum += mesh ? mesh->triangles.size() / 3 : 0;
    return sum;
}

SurfaceColors& KnownCrossings::of(const std::shared_ptr<const IndexFile>& file,
                                  const SurfacesQuery& query) {
    const auto found = std::ranges::find_if(known_, [&](const Known& each) {
        return each.file == file && each.surfaces == query.isovalues.size();
    });
    if (found != known_.end())
        known_.splice(known_.end(), known_, found);
    else
        known_.push_back({file, query.isovalues.size(), SurfaceColors(file, std::nullopt)});
    if (known_.size() > kMostSurfaces)
        known_.pop_front();
    return known_.back().colors;
}

InstantSurfacesPtr instant_surfaces(const std::shared_ptr<const IndexFile>& file,
                                    const SurfacesQuery& query, std::uint64_t most,
                                    const std::stop_token& stop, KnownCrossings* known) {
    KnownCrossings none;
    InstantMeshes maker(file, query, stop);
    std::vector<CellMesh> meshes;
    auto made = std::make_shared<InstantSurfaces>();
    made->query = query;
    made->most = most;
    try {
        const auto level = maker.finest(kMadeForOne * most);
        if (!level || !maker.make(*level, meshes, known ? *known : none))
            return nullptr;
        made->level = *level;
    } catch (const Stopped&) {
        return nullptr;
    }
    for (std::size_t i = 0; made->level == 0 && !query.pieces.keeps_all() && i < meshes.size(); ++i)
        keep(meshes[i],
             kept_pieces(meshes[i], file->info().grid, is_complete(*file), query.pieces, i));
    for (const CellMesh& mesh : meshes)
        made->cells += mesh.cases.size();
    made->edge = simplify(meshes, most, made->level, stop);
    if (made->edge == 0)
        return nullptr;
    for (CellMesh& mesh : meshes) {
        made->boxes.push_back(boxes_of(mesh, file->info().grid));
        made->meshes.push_back(
            mesh.triangles.empty() ? nullptr : std::make_shared<const CellMesh>(std::move(mesh)));
    }
    return made;
}

} // namespace isochron::index
