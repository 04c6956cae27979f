// What quads and splats of cells stand for.
#pragma once

#include <cstdint>

namespace isochron::render {

enum class CellShape : std::uint8_t {
    plane, ///< a flat ellipsoid on the surface: the plane that cuts the cell as the surface does
    voxel  ///< a sphere about the cell's middle, the paper's
};

/// `plane`, `voxel`.
const char* name_of(CellShape shape);

/// The ellipsoids of plane.glsl, or the spheres.
struct SplatShape {
    CellShape shape = CellShape::plane;
    /// Of the sphere, or in its plane of the largest ellipsoid [voxels].
    float radius = 0.8f;

    static constexpr float kThickness = 0.125f; ///< along the normal, as a share of the radius
    static constexpr float kLeastWidth = 0.15f; ///< in the plane, likewise
    static constexpr float kLengthwise = 1.3f;  ///< lengthwise over the part in the cell
    /// Of the way from the cell's farthest corner to the plane, which is kept in steps as large: a
    /// plane on a cell's face is in no other cell.
    static constexpr float kLeastRest = 0.007f;
};

} // namespace isochron::render
