// Counts the cells of pieces, and finds the pieces nearest to places.
#include "index/measure/kept_pieces.h"

#include "index/surface/mesh_cases.h"
#include "index/surface/mesh_crop.h"
#include "index/surface/triangle_distance.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace isochron::index {
namespace {

/// The mesh's vertices as places in space are compared with them.
class NearestPiece {
  public:
    NearestPiece(const CellMesh& mesh, const Grid& grid,
                 const std::vector<std::uint32_t>& of_triangle)
        : mesh_(mesh), grid_(grid), of_triangle_(of_triangle) {
        points_.reserve(mesh.vertices.size());
        for (const MeshVertex& vertex : mesh.vertices)
            points_.push_back(grid.physical(position_of(vertex)));
        // A triangle lies in one cell.
        glm::dvec3 longest(0.0);
        for (int axis = 0; axis < 3; ++axis)
            for (std::uint32_t i = 1; i < grid.vertices[static_cast<std::size_t>(axis)]; ++i)
                longest[axis] =
                    std::max(longest[axis], grid.distance(axis, i) - grid.distance(axis, i - 1.0));
        for (int axis = 0; axis < 3; ++axis)
            widest_ += longest[axis] * glm::length(grid.direction[axis]);
    }

    /// @param cells at most so many cells away along each axis; none: however far
    std::optional<std::uint32_t> at(const glm::dvec3& place, std::optional<double> cells) const {
        double nearest = std::numeric_limits<double>::infinity(); // squared
        for (const glm::dvec3& point : points_)
            nearest = std::min(nearest, squared(point - place));
        const double reach = std::sqrt(nearest) + widest_, reach2 = reach * reach;
        nearest = std::numeric_limits<double>::infinity();
        std::optional<std::size_t> found;
        for (std::size_t i = 0; i < of_triangle_.size(); ++i) {
            const std::uint32_t* const corners = &mesh_.triangles[3 * i];
            const glm::dvec3& first = points_[corners[0]];
            if (squared(first - place) > reach2)
                continue;
            const double here =
                squared_distance(place, {first, points_[corners[1]], points_[corners[2]]});
            if (here < nearest) {
                nearest = here;
                found = i;
            }
        }
        if (!found || (cells && cells_away(*found, place) > *cells))
            return std::nullopt;
        return of_triangle_[*found];
    }

  private:
    static double squared(const glm::dvec3& v) { return glm::dot(v, v); }
    /// From the box around a triangle in index coordinates, along the axis where it is farthest.
    double cells_away(std::size_t triangle, const glm::dvec3& place) const {
        const glm::dvec3 at = grid_.index_of(place);
        glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
        for (const std::uint32_t corner : std::span(mesh_.triangles).subspan(3 * triangle, 3)) {
            const glm::dvec3 point = position_of(mesh_.vertices[corner]);
            low = glm::min(low, point);
            high = glm::max(high, point);
        }
        const glm::dvec3 off = glm::max(low - at, at - high);
        return std::max({off.x, off.y, off.z});
    }

    const CellMesh& mesh_;
    const Grid& grid_;
    const std::vector<std::uint32_t>& of_triangle_;
    std::vector<glm::dvec3> points_;
    double widest_ = 0; ///< no triangle is wider
};

constexpr double kNear = 2; ///< [cells] from a hidden place to its piece

} // namespace

std::vector<std::uint8_t> triangles_of_cells(const CellMesh& mesh) {
    std::vector<std::uint8_t> triangles;
    triangles.reserve(mesh.cases.size());
    for (const std::uint8_t which : mesh.cases)
        triangles.push_back(mesh_cases()[which].triangles);
    return triangles;
}

std::vector<std::uint32_t> cells_of_pieces(std::span<const std::uint8_t> triangles,
                                           const MeshPieces& pieces) {
    std::vector<std::uint32_t> cells(pieces.count);
    const std::uint32_t* of = pieces.of_triangle.data();
    for (const std::uint8_t count : triangles) {
        for (std::uint8_t i = 0; i < count; ++i)
            if (std::find(of, of + i, of[i]) == of + i) // not counted yet
                ++cells[of[i]];
        of += count;
    }
    return cells;
}

PieceFilter of_surface(const PieceFilter& filter, std::uint32_t surface) {
    PieceFilter one{.only = {}, .hidden = {}, .dust = filter.dust};
    for (const PieceAt& each : filter.only)
        if (each.surface == surface)
            one.only.push_back({0, each.place});
    for (const PieceAt& each : filter.hidden)
        if (each.surface == surface)
            one.hidden.push_back({0, each.place});
    return one;
}

KeptPieces kept_pieces(const CellMesh& mesh, const Grid& grid, bool complete,
                       const PieceFilter& filter, std::size_t surface) {
    const auto concerns = [&](const PieceAt& at) { return at.surface == surface; };
    const bool only = std::ranges::any_of(filter.only, concerns),
               hides = std::ranges::any_of(filter.hidden, concerns);
    KeptPieces kept;
    if (!only && !hides && filter.dust == 0)
        return kept;
    const MeshPieces pieces = pieces_of(mesh, grid, complete);
    kept.all = kept.kept = pieces.count;
    std::vector<std::uint8_t> stays(pieces.count, 1);
    if (only) {
        std::ranges::fill(stays, std::uint8_t{0});
    } else if (filter.dust > 0) {
        const auto cells = cells_of_pieces(triangles_of_cells(mesh), pieces);
        for (std::size_t i = 0; i < stays.size(); ++i)
            stays[i] = cells[i] >= filter.dust;
    }
    if (only || hides) {
        const NearestPiece nearest(mesh, grid, pieces.of_triangle);
        for (const PieceAt& at : filter.only)
            if (const auto piece = concerns(at) ? nearest.at(at.place, {}) : std::nullopt)
                stays[*piece] = 1;
        for (const PieceAt& at : filter.hidden)
            if (const auto piece = concerns(at) ? nearest.at(at.place, kNear) : std::nullopt)
                stays[*piece] = 0;
    }
    kept.kept = static_cast<std::uint32_t>(std::ranges::count(stays, 1));
    if (kept.kept == kept.all)
        return kept;
    kept.triangles.reserve(pieces.of_triangle.size());
    for (const std::uint32_t piece : pieces.of_triangle)
        kept.triangles.push_back(stays[piece]);
    kept.cells.reserve(mesh.cases.size());
    std::size_t first = 0;
    for (const std::uint8_t which : mesh.cases) {
        const std::size_t count = mesh_cases()[which].triangles;
        const auto triangles = std::span(kept.triangles).subspan(first, count);
        kept.cells.push_back(std::ranges::find(triangles, 1) != triangles.end());
        first += count;
    }
    return kept;
}

void keep(CellMesh& mesh, const KeptPieces& kept) {
    if (!kept.triangles.empty())
        keep_triangles(mesh, kept.triangles);
}

} // namespace isochron::index
