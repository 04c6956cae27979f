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

/// What stands for the surface in a cell.
struct SplatShape {
    CellShape shape = CellShape::plane;
    /// Radius of the sphere, or of the largest ellipsoid in its plane [voxels]; for quads on planes,
    /// half a side of the enlarged cell.
    float radius = 1.45f;
    /// On a plane: a quad, which is the plane's part in the cell, a little enlarged; else an
    /// ellipsoid around that part.
    bool quad = false;

    bool is_cut() const { return quad && shape == CellShape::plane; }

    // How ellipsoids on planes are drawn, as shares of the radius, as ellipse.glsl has them:
    static constexpr float kThickness = 0.125f; ///< along the normal
    static constexpr float kLengthwise = 1.3f;  ///< over the part in the cell
    static constexpr float kLeastWidth = 0.15f; ///< in the plane
    /// Least distance from the plane to the cell's farthest corner on its side, about one step of a
    /// stored offset, so that a plane at the cell's very end still has an extent [voxels].
    static constexpr float kLeastRest = 0.007f;

    // How quads on planes are drawn, as cut.glsl has them:
    /// Least cosine between the plane's normal and the way to the eye: a plane that is seen edge-on
    /// is turned so far.
    static constexpr float kLeastCosine = 0.02f;
    /// Two stripes are parallel if the difference of products that tells how they cross is at most
    /// this share of their sum.
    static constexpr float kParallel = 1e-5f;
    /// The outline is not straight in the picture if the eye is so many cells away, or nearer,
    /// measured along the cell's diagonal.
    static constexpr float kNearEye = 2.0f;
};

} // namespace isochron::render
