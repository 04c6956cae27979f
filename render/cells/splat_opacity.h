// The opacity of splats for a surface of a given opacity.
#pragma once

namespace isochron::render {

/// Opacity in the middle of a Gaussian splat with which the splats of a surface together let
/// 1 - `surface_opacity` of the light through. A surface has about 1.5 cells per unit of area, so
/// their optical depths add up to 1.5 * 2 pi sigma^2 Li2(alpha), with the dilogarithm Li2.
/// @param sigma of the splats, voxels
float splat_opacity(float surface_opacity, float sigma);

} // namespace isochron::render
