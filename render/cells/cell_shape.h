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
    float radius = 0.8f;

    static constexpr float kThickness = 0.125f; ///< along the normal, as a share of the radius
    static constexpr float kLeastWidth = 0.15f; ///< in the plane, likewise
    static constexpr float kLengthwise = 1.3f;  ///< lengthwise over the part in the cell
    /// Least distance from the plane to the cell's farthest corner on its side, about one step of a
    /// stored offset, so that a plane at the cell's very end still has an extent [voxels].
    static constexpr float kLeastRest = 0.007f;
};

} // namespace isochron::render
