// Joins triangles by vertices where that is enough, else by edges.
#include "index/measure/mesh_pieces.h"

#include "index/measure/disjoint_sets.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

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
    const std::span<const std::uint32_t> corners = mesh.triangles;
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

bool is_complete(const IndexFile& file) {
    const std::vector<std::uint64_t>& bins = file.stats().counts.bins;
    return std::accumulate(bins.begin(), bins.end(), std::uint64_t{0}) ==
           file.info().grid.vertex_count() * file.info().steps();
}

MeshPieces pieces_of(std::span<const std::uint32_t> corners) {
    struct Side {
        std::uint32_t high, triangle;
    };
    // Sides by the lower one of their vertices, of which few share one.
    std::vector<std::uint32_t> ends(corners.empty() ? 1 : std::ranges::max(corners) + 2);
    const auto low_and_high = [&](std::size_t i) {
        const std::size_t first = i / 3 * 3;
        return std::minmax(corners[i], corners[first + (i - first + 1) % 3]);
    };
    for (std::size_t i = 0; i < corners.size(); ++i)
        ++ends[low_and_high(i).first + 1];
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    std::vector<Side> sides(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) { // ends become those of the sides so far
        const auto [low, high] = low_and_high(i);
        sides[ends[low]++] = {high, static_cast<std::uint32_t>(i / 3)};
    }
    const std::size_t triangles = corners.size() / 3;
    DisjointSets sets(triangles);
    std::vector<std::uint32_t> alone; ///< triangles of edges that no other has
    for (std::size_t low = 0, begin = 0; low + 1 < ends.size(); begin = ends[low++]) {
        const auto here = std::span(sides).subspan(begin, ends[low] - begin);
        std::ranges::sort(here, {}, &Side::high);
        for (std::size_t i = 0, end; i < here.size(); i = end) {
            for (end = i + 1; end < here.size() && here[end].high == here[i].high; ++end)
                sets.join(here[i].triangle, here[end].triangle);
            if (end == i + 1)
                alone.push_back(here[i].triangle);
        }
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
