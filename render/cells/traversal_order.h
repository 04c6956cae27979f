// Back-to-front order of cells for an eye anywhere, in linear time.
//
// Cells are sorted by their distance from a reference point that lies on the same side of every
// plane of the grid as the eye does. The order is exact for every such eye: what hides a cell is no
// farther off along any axis, and nearer along one. And it changes little at a time: where the
// traversal by slices, rows and cells (Botha and Post, "ShellSplatting: Interactive rendering of
// anisotropic volumes", VisSym 2003) turns over as a whole when the eye's longest axis changes,
// which is seen as a pop of splats that overlap, here two cells change places when they are equally
// far away.
#pragma once

#include "render/cells/slot_plan.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace isochron::render {

/// What the order depends on: eyes with equal keys share one order of a set.
struct TraversalKey {
    /// A position in the eye's cell, or beyond the grid as the eye is, in eighths of a cell, w = 1.
    /// For a parallel view the signs of the direction towards the eye, w = 0.
    glm::ivec4 reference{0, 0, 0, 1};
    /// Per axis the weight of a squared distance (w = 1) or of a distance (w = 0), fixed point with
    /// kWeightBits binary digits, at least 1.
    glm::ivec3 weights{1};
    bool operator==(const TraversalKey&) const = default;
};

constexpr int kWeightBits = 4;

/// An eye within the grid's range of an axis keeps its quarter of a cell there; beyond it the
/// reference is coarser the farther off the eye, a tenth to a fifth of a degree, so that a standing
/// head sorts rarely and what a new order changes is not seen.
/// @param eye homogeneous, in vertex index coordinates: w = 1 for a position (on a voxel plane
///        either neighbor is right), w = 0 for the direction towards the eye of a parallel view
/// @param cells number of cells per axis
/// @param spacing of the grid in space, in any unit
TraversalKey traversal_key(const glm::vec4& eye, const glm::ivec3& cells, const glm::vec3& spacing);

/// Writes the slots such that no cell's box is in front of a later one's, by radix sort; cells at
/// the same distance keep their ranks, so that the order does not depend on who has which slot.
void order_back_to_front(const Slots& slots, const TraversalKey& key,
                         std::vector<std::uint32_t>& order);

} // namespace isochron::render
