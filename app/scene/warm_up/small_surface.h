// A surface in one cell, with all that any footprint needs: to be drawn before there are data.
#pragma once

#include "index/extraction/extraction.h"
#include "index/volume/grid.h"
#include "render/cells/placement.h"
#include "render/drawing/cell_pass.h"
#include "render/gl/view.h"

#include <span>

namespace isochron::app {

/// A grid of 4^3 vertices. @param rectilinear whether it has positions of its own
index::Grid small_grid(bool rectilinear);

/// A plane through the cell in the middle of this grid, across its third axis: with its point, a
/// mesh and the volume around it.
index::ExtractionPtr small_surface(const index::Grid& grid);

/// Draws such a surface with each of these footprints, opaque and translucent, in three sizes: as
/// small as voxels in the middle of a volume, many pixels large, and as large as for a viewer
/// inside the volume.
void draw_small_surface(const render::Gl& gl, render::CellPass& pass,
                        std::span<const render::View> views, const index::Grid& volume,
                        const glm::dmat4& room_from_physical,
                        std::span<const render::Footprint> footprints,
                        const render::CellAppearance& configured);

} // namespace isochron::app
