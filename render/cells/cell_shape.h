// The shape that a cell's quad or splat stands for.
#pragma once

#include <cstdint>

namespace isochron::render {

enum class CellShape : std::uint8_t {
    plane, ///< a flat ellipsoid on the plane that approximates the surface in the cell
    voxel  ///< a sphere around the cell's middle, as in the paper
};

/// `plane`, `voxel`.
const char* name_of(CellShape shape);

/// The ellipsoids of plane.glsl, or the spheres.
struct SplatShape {
    CellShape shape = CellShape::plane;
    /// Radius of the sphere, or of the largest ellipsoid in its plane [voxels].
    float radius = 0.9f;
    bool quad = false;    ///< opaque, else a Gaussian
    bool in_cell = false; ///< only what lies in the cell, a little enlarged, is there

    /// Along the normal, as a share of the radius.
    float thickness() const { return quad ? 0.03f : 0.125f; }
    /// Lengthwise over the part in the cell.
    float lengthwise() const { return quad ? 0.8f : 1.3f; }
    static constexpr float kLeastWidth = 0.15f; ///< in the plane, as a share of the radius
    /// Least distance from the plane to the cell's farthest corner on its side, about one step of a
    /// stored offset, so that a plane at the cell's very end still has an extent [voxels].
    static constexpr float kLeastRest = 0.007f;
    /// Half a side of the enlarged cell, as a share of the radius: planes of neighbors differ, so
    /// each goes on a little behind the common face.
    static constexpr float kHalfCell = 0.7f;
};

} // namespace isochron::render
