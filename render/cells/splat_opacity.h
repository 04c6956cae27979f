// How opaque splats are for a surface of some opacity.
#pragma once

namespace isochron::render {

/// Opacity of the middle of a Gaussian splat, such that the splats of a surface, about 1.5 cells
/// for each unit of its area, let 1 - `surface_opacity` of the light through: their optical depths
/// add up to 1.5 * 2 pi sigma^2 Li2(alpha), Li2 the dilogarithm.
/// @param sigma of the splats, voxels
float splat_opacity(float surface_opacity, float sigma);

} // namespace isochron::render
