// Back-to-front order of cells for an eye anywhere, in linear time.
//
// Cells are sorted by their distance from a reference point that lies on the same side of every
// grid plane as the eye. The order is exact for every such eye: a cell that hides another one is
// not farther away along any axis, and nearer along at least one. The order also changes gradually:
// two cells change places only when they are equally far away. In the traversal by slices, rows and
// cells (Botha and Post, "ShellSplatting: Interactive rendering of anisotropic volumes", VisSym
// 2003) the whole order changes with the eye's longest axis, which shows as popping of overlapping
// splats.
#pragma once

#include "render/cells/slot_assignment.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace isochron::render {

/// What the order depends on: eyes with equal keys share one order of a set.
struct TraversalKey {
    /// With w = 1 a position in the eye's cell, or outside the grid as the eye is, in eighths of a
    /// cell. With w = 0 (parallel view) the signs of the direction towards the eye.
    glm::ivec4 reference{0, 0, 0, 1};
    /// Per axis the weight of a squared distance (w = 1) or of a distance (w = 0): fixed point with
    /// kWeightBits fractional bits, at least 1.
    glm::ivec3 weights{1};
    bool operator==(const TraversalKey&) const = default;
};

constexpr int kWeightBits = 4;

/// Along an axis where the eye is within the grid's range, the reference is its quarter of a cell.
/// Outside the range the reference becomes coarser with the eye's distance (a tenth to a fifth of a
/// degree), so that a head at rest causes few sorts, and changes of the order are not visible.
/// @param eye homogeneous, in vertex index coordinates: w = 1 for a position (on a voxel plane
///        either neighbor is right), w = 0 for the direction towards the eye of a parallel view
/// @param cells number of cells per axis
/// @param spacing of the grid in space, in any unit
TraversalKey traversal_key(const glm::vec4& eye, const glm::ivec3& cells, const glm::vec3& spacing);

/// Sorts the slots (radix sort) so that no cell hides a later one. Cells at the same distance are
/// in order of rank, so that the result does not depend on the assignment of slots.
void order_back_to_front(const Slots& slots, const TraversalKey& key,
                         std::vector<std::uint32_t>& order);

class SortPasses; ///< the passes of a radix sort

/// Sorts back to front in pieces, as all of it may take longer than a frame.
class BackToFrontSort {
  public:
    BackToFrontSort(const Slots& slots, const TraversalKey& key);
    BackToFrontSort(BackToFrontSort&&) noexcept;
    BackToFrontSort& operator=(BackToFrontSort&&) noexcept;
    ~BackToFrontSort();

    /// All of it: passes times cells.
    std::size_t work() const;
    /// Sorts on until so much of the work is done. @param slots the same as before
    void advance(const Slots& slots, std::size_t to);
    /// The order, once all the work is done.
    std::vector<std::uint32_t> take();

  private:
    std::unique_ptr<SortPasses> passes_; ///< null without cells
    std::size_t cells_ = 0, done_ = 0;
};

} // namespace isochron::render
