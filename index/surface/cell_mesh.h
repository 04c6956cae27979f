// The triangle mesh of an isosurface, made from its active cells only.
#pragma once

#include "index/surface/gpu_formats.h"
#include "index/system/kept_memory.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace isochron::index {

/// The vertex's position in vertex index coordinates; `Grid::physical` has its place in space.
glm::dvec3 position_of(const MeshVertex& vertex);
/// The unit normal, or zero if the vertex has none.
glm::dvec3 normal_of(const MeshVertex& vertex);

/// The surface of a cell set, cell after cell in the order of its ids. Every cut edge has one
/// vertex, which all triangles share. An edge is cut if one end is below the isovalue and the other
/// is not. The cut may be at an end of the edge, so that several vertices may lie in one vertex of
/// the grid. Cells with a NaN vertex have no triangles: the surface has a border there. Positions
/// are interpolated linearly between the ends of an edge, and so are normals, from central
/// differences (one-sided at the border of the grid). If one end is infinite, the cut is at the
/// other one.
struct CellMesh {
    KeptVector<MeshVertex> vertices;
    /// Three vertices each, counter-clockwise as seen from the side of lower values.
    KeptVector<std::uint32_t> triangles;
    /// Case of each cell, see mesh_cases.h: gives its triangle count.
    KeptVector<std::uint8_t> cases;
    std::vector<float> values; ///< values of another array at the vertices, if they were asked for
    /// Fine color coordinates (cell_colors.h) of the vertices; empty if the surface has no colors.
    std::vector<std::uint16_t> colors;

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
