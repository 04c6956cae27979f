// Triangles of a mesh in the order of planes of cells: near ones first hide most of the others.
#pragma once

#include "index/surface/cell_mesh.h"
#include "render/cells/slot_assignment.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace isochron::render {

/// Planes of cells across an axis, one after the other.
struct PlaneOrder {
    int axis = 2;
    bool descending = false; ///< from high coordinates to low ones

    bool operator==(const PlaneOrder&) const = default;
    /// That of the mesh itself, whose cells are in order of their ids.
    bool of_mesh() const { return *this == PlaneOrder{}; }
};

/// The order in which planes that are nearer to the eye come first, across the axis along which the
/// eye is farthest from the middle of the volume.
/// @param eye homogeneous, in even coordinates: w = 0 for the direction towards it
/// @param extent of the volume, in even coordinates
/// @param spacing of even coordinates, in any unit
PlaneOrder near_planes_first(const glm::vec4& eye, const glm::vec3& extent,
                             const glm::vec3& spacing);

/// Appends the triangles of a surface in this order. Triangles of one plane stay in the order of
/// cells.
/// @param cells of the surface, in order of their ids
/// @param corners of triangles: three vertices each
void append_in_order(std::span<const CellPlace> cells, const index::CellMesh& mesh,
                     PlaneOrder order, std::vector<std::uint32_t>& corners);
/// Appends a mesh whose triangles belong to no cells, ordered by their first vertices.
void append_in_order(const index::CellMesh& mesh, PlaneOrder order,
                     std::vector<std::uint32_t>& corners);

/// Triangles of several meshes, the farthest first, by the distances of their first vertices.
/// @param first_vertices of each mesh, added to the numbers of its vertices
/// @param ahead distance along the view, in any unit, of a vertex at index coordinates: x, y, z, 1
std::vector<std::uint32_t> far_first(std::span<const index::CellMeshPtr> meshes,
                                     std::span<const std::size_t> first_vertices,
                                     const glm::vec4& ahead);
/// Triangles of which the distances are known. @param corners three of each
std::vector<std::uint32_t> far_first(std::span<const float> distances,
                                     std::span<const std::uint32_t> corners);

} // namespace isochron::render
