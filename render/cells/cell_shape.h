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

    static constexpr float kThickness = 0.125f; ///< half axis along the normal, in radii
    static constexpr float kLeastWidth = 0.15f; ///< least half axis in the plane, in radii
    static constexpr float kLengthwise = 1.3f;  ///< length relative to the plane's part in the cell
};

} // namespace isochron::render
