// Joins triangles by vertices where that is enough, else by edges.
#include "index/measure/mesh_pieces.h"

#include "index/measure/disjoint_sets.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace isochron::index {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Numbers the sets in the order in which they come. @param set_of the set of a triangle
template <class SetOf>
MeshPieces numbered(std::size_t triangles, std::size_t sets, const SetOf& set_of) {
    MeshPieces pieces;
    pieces.of_triangle.reserve(triangles);
    std::vector<std::uint32_t> numbers(sets, kNone);
    for (std::uint32_t i = 0; i < triangles; ++i) {
        std::uint32_t& number = numbers[set_of(i)];
        if (number == kNone)
            number = pieces.count++;
        pieces.of_triangle.push_back(number);
    }
    pieces.border_edges.resize(pieces.count);
    return pieces;
}

/// Whether a cut edge lies in a face of the grid.
bool is_at_border(const MeshVertex& vertex, const Grid& grid) {
    const std::array<std::uint32_t, 3> at{vertex.x, vertex.y, vertex.z};
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (axis != vertex.axis && (at[axis] == 0 || at[axis] + 1 == grid.vertices[axis]))
            return true;
    return false;
}

/// Around each vertex the triangles are one fan, so that vertices join what edges join; at the
/// border of the grid, which consists of closed lines, there are as many vertices as edges.
MeshPieces by_vertices(const CellMesh& mesh, const Grid& grid) {
    DisjointSets sets(mesh.vertices.size());
    const std::vector<std::uint32_t>& corners = mesh.triangles;
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        sets.join(corners[i], corners[i + 1]);
        sets.join(corners[i], corners[i + 2]);
    }
    MeshPieces pieces = numbered(corners.size() / 3, mesh.vertices.size(), [&](std::uint32_t i) {
        return sets.least_of(corners[std::size_t{3} * i]);
    });
    std::vector<std::uint32_t> piece_of_set(mesh.vertices.size());
    for (std::size_t i = 0; i < corners.size(); i += 3)
        piece_of_set[sets.least_of(corners[i])] = pieces.of_triangle[i / 3];
    for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i)
        if (is_at_border(mesh.vertices[i], grid))
            ++pieces.border_edges[piece_of_set[sets.least_of(i)]];
    return pieces;
}

} // namespace

MeshPieces pieces_of(std::span<const std::uint32_t> corners) {
    struct Side {
        std::uint32_t low, high, triangle;
    };
    std::vector<Side> sides;
    sides.reserve(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::size_t first = i / 3 * 3;
        const auto [low, high] = std::minmax(corners[i], corners[first + (i - first + 1) % 3]);
        sides.push_back({low, high, static_cast<std::uint32_t>(i / 3)});
    }
    const auto edge = [](const Side& side) { return std::pair(side.low, side.high); };
    std::ranges::sort(sides, {}, edge);
    const std::size_t triangles = corners.size() / 3;
    DisjointSets sets(triangles);
    std::vector<std::uint32_t> alone; ///< triangles of edges that no other has
    for (std::size_t i = 0, end; i < sides.size(); i = end) {
        for (end = i + 1; end < sides.size() && edge(sides[end]) == edge(sides[i]); ++end)
            sets.join(sides[i].triangle, sides[end].triangle);
        if (end == i + 1)
            alone.push_back(sides[i].triangle);
    }
    MeshPieces pieces =
        numbered(triangles, triangles, [&](std::uint32_t i) { return sets.least_of(i); });
    for (const std::uint32_t triangle : alone)
        ++pieces.border_edges[pieces.of_triangle[triangle]];
    return pieces;
}

MeshPieces pieces_of(const CellMesh& mesh, const Grid& grid, bool complete) {
    return complete ? by_vertices(mesh, grid) : pieces_of(mesh.triangles);
}

} // namespace isochron::index
