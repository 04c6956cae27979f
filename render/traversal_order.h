// Back-to-front order of cells for an eye anywhere, in linear time.
//
// After Botha and Post, "ShellSplatting: Interactive rendering of anisotropic volumes",
// VisSym 2003: seen from a grid cell, the slices on either side of it hide each other towards it
// only, and so do the rows of a slice and the cells of a row.
#pragma once

#include "index/cell_set.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::render {

/// What the order depends on: eyes with equal keys share one order of a set.
struct TraversalKey {
    /// Per axis the cell coordinate that the eye lies in, -1 below the volume, its size above.
    glm::ivec3 eye_cell{0};
    /// The axes from the slowest (slices) to the fastest: along the first the eye is farthest off,
    /// so that slices follow each other in depth as closely as a grid allows.
    std::array<std::uint8_t, 3> axes{2, 1, 0};
    bool operator==(const TraversalKey&) const = default;
};

/// @param eye homogeneous, in vertex index coordinates: w = 1 for a position (on a voxel plane
///        either neighbour is right), w = 0 for the direction towards the eye of a parallel view
/// @param cells number of cells per axis
TraversalKey traversal_key(const glm::vec4& eye, const glm::ivec3& cells);

/// Writes a permutation of 0 .. points.size()-1 such that no cell's box is in front of a later
/// one's. Three counting sorts: linear in the number of cells plus the size of the grid's sides.
void order_back_to_front(std::span<const index::CellPoint> points, const TraversalKey& key,
                         const glm::ivec3& cells, std::vector<std::uint32_t>& order);

} // namespace isochron::render
