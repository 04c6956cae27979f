// Whether cells can be drawn as points, which on software GL take half the time of quads.
#pragma once

#include "render/cells/placement.h"
#include "render/gl/view.h"

namespace isochron::render {

/// GL drops a point whose center is outside of the viewport, and lets one inside draw beyond the
/// viewport's edge. So points are right only where no footprint of any cell that the volume could
/// have crosses an edge, or comes so near to the eye's plane that its outline is no ellipse. A
/// point is as wide as the longest side of what it shows: where spacing is far from even, quads
/// are smaller.
/// @param radius of the footprint, voxels
/// @param reach how far its outline goes, in radii: 1 where it is the ellipse
/// @param largest_point widest point that the driver draws, pixels
bool points_serve(const View& view, const Placement& placement, float radius, float reach,
                  float largest_point);

/// Whether the rectangles of all cells that the volume could have are, within three quarters of a
/// pixel, upright squares: then a point is the whole footprint, and its fragments have nothing to
/// look up or to discard. So it is where voxels are cubes, pixels are squares, and footprints are
/// small or near to the middle of the view: perspective stretches a sphere by 1 / cos of its angle
/// off the screen's normal. Only where `points_serve`.
/// @param radius of the footprint, voxels
bool footprints_are_squares(const View& view, const Placement& placement, float radius);

/// As in cell.vert: where d = w^2 - (r |row w|)^2 of a cell is not above this share of its w^2, it
/// is so near to the eye's plane that its outline is drawn in another way.
constexpr float kLeastDepth = 0.1f;

/// Corners of the rectangle on an ellipse's axes are farther out than the ellipse: by sqrt(2), and
/// a little since perspective magnifies the nearer parts.
constexpr float kReachOfRectangle = 1.5f;

/// The middle of an ellipsoid on a plane is at most so far from its cell's middle [voxels].
constexpr float kFarthestPlane = 0.87f;

} // namespace isochron::render
