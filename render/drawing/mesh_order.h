// Triangles of a mesh in the order of planes of cells: near ones first hide most of the others.
#pragma once

#include "index/surface/cell_mesh.h"
#include "render/cells/slot_plan.h"

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

/// Triangles in some order.
struct OrderedTriangles {
    std::vector<std::uint32_t> corners; ///< three vertices each
    std::vector<std::uint32_t>
        numbers; ///< of each triangle in its mesh; meshes are counted through
};

/// Appends the triangles of a surface in this order. Triangles of one plane stay in the order of
/// cells.
/// @param cells of the surface, in order of their ids
void append_in_order(std::span<const CellPlace> cells, const index::CellMesh& mesh,
                     PlaneOrder order, OrderedTriangles& triangles);

} // namespace isochron::render
