// Triangles of an isosurface, made from its active cells alone.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace isochron::index {

/// Where the surface cuts an edge of the grid, as the GPU takes it: 16 bytes, no padding.
struct MeshVertex {
    std::uint16_t x, y, z; ///< the lower end of the edge, vertex index coordinates
    std::uint16_t axis;    ///< that the edge runs along, 0 to 2
    std::uint32_t share;   ///< of the way to the edge's upper end, 0 to kWhole
    /// Coordinates on the octahedron (see cell_plane.h), signed 16 bits each from -32767 to 32767,
    /// x in the lower half: towards lower values, in physical space. kNoNormal where the gradient
    /// vanishes or is not finite.
    std::uint32_t normal;

    static constexpr std::uint32_t kWhole = 1u << 31, kNoNormal = 0x80008000u;
    static constexpr int kOne = 32767; ///< stands for 1 among the normal's coordinates
    bool operator==(const MeshVertex&) const = default;
};
static_assert(sizeof(MeshVertex) == 16);

/// In vertex index coordinates.
glm::dvec3 position_of(const MeshVertex& vertex);
/// Of length 1, or zero where there is none.
glm::dvec3 normal_of(const MeshVertex& vertex);

/// The surface of a cell set, cell after cell in the order of its ids. Every cut edge has one
/// vertex, which all triangles share. An edge is cut where one end is below the isovalue and the
/// other is not; both ends of the way count, so that vertices may meet in a vertex of the grid.
/// Cells with a NaN have no part in it: the surface has a border there.
/// Linear between the ends of an edge; normals likewise, of central differences (one-sided at the
/// border of the grid). Where an end is infinite, the cut is at the other one.
struct CellMesh {
    std::vector<MeshVertex> vertices;
    /// Three vertices each, counter-clockwise for who looks from the side of lower values.
    std::vector<std::uint32_t> triangles;
    std::vector<std::uint8_t> cases; ///< by cell, see mesh_cases.h: how many triangles it has

    bool operator==(const CellMesh&) const = default;
};

using CellMeshPtr = std::shared_ptr<const CellMesh>;

std::uint64_t bytes_of(const CellMesh& mesh);
/// What the mesh of so many active cells takes at least: each has a triangle. Most have two, and
/// about one vertex.
constexpr std::uint64_t least_mesh_bytes(std::size_t cells) {
    return cells * (3 * sizeof(std::uint32_t) + 1);
}

} // namespace isochron::index
