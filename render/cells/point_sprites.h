// Decides whether cells can be drawn as points, which take half the time of quads on software GL.
#pragma once

#include "render/cells/placement.h"
#include "render/gl/view.h"

namespace isochron::render {

/// Whether points show the same as quads. GL drops a point whose center is outside the viewport,
/// and draws one inside also beyond the viewport's edge. So no footprint of any cell that the
/// volume could have may cross an edge, or come so near to the eye's plane that its outline is no
/// ellipse.
/// A point is as wide as the longest side of the footprint, so with very uneven spacing quads are
/// smaller, and this is false; so it is on a rectilinear grid.
/// @param radius of the footprint, voxels
/// @param reach of its outline, in radii: 1 for the ellipse itself
/// @param largest_point widest point that the driver draws, pixels
bool points_serve(const View& view, const Placement& placement, float radius, float reach,
                  float largest_point);

/// Whether the rectangles of all cells that the volume could have are upright squares, within three
/// quarters of a pixel: then a point is the whole footprint, and fragments need no tests. This
/// holds if voxels are cubes, pixels are squares, and footprints are small or near the middle of
/// the view:
/// perspective stretches a sphere by 1 / cos of its angle to the screen's normal. Call it only if
/// `points_serve`.
/// @param radius of the footprint, voxels
bool footprints_are_squares(const View& view, const Placement& placement, float radius);

/// As in cell.vert: if d = w^2 - (r |row w|)^2 of a cell is at most this share of its w^2, it is so
/// near to the eye's plane that its outline is drawn in another way.
constexpr float kLeastDepth = 0.1f;

/// Reach of the corners of the rectangle on an ellipse's axes: sqrt(2), and a little more because
/// perspective magnifies nearer parts.
constexpr float kReachOfRectangle = 1.5f;

/// Largest distance between the middles of a cell and of the ellipsoid on its plane [voxels].
constexpr float kFarthestPlane = 0.87f;

/// Longest way from a place in a cell to another, in halves of the cell's sides: 2 sqrt(3), and a
/// little more.
constexpr float kMostOfCut = 3.5f;

} // namespace isochron::render
