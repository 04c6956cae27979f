// Where the data and their surfaces lie in the view of the eyes, and whether a clip plane leaves
// anything of them.
#pragma once

#include "app/frame/empty_picture.h"
#include "index/extraction/extraction.h"
#include "index/volume/grid.h"
#include "interaction/setting_values.h"
#include "render/gl/view.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace isochron::app {

/// The corners of a box, physical space.
using BoxCorners = std::array<glm::dvec3, 8>;
BoxCorners corners_of(const index::Grid& grid);
/// The corners of the box, along the grid's axes, around all cells of the visible surfaces.
/// @param visible a bit for each surface
/// @return empty: there are no such cells, or they are of coarser levels
std::optional<BoxCorners> corners_of(const index::Extraction& cells, const index::Grid& grid,
                                     std::uint32_t visible);

/// Whether each cell of the visible surfaces lies beyond one of the planes that cut. @return false
/// where the cells are of coarser levels
bool is_cut_away(const index::Extraction& cells, const index::Grid& grid, std::uint32_t visible,
                 std::span<const interaction::ClipPlane> cuts);

/// How a box lies in the views; `in_view` also without a view. Where it is not certain that nothing
/// is seen of the box, it is in view.
Sight sight_of(const BoxCorners& box, const interaction::Similarity& room_from_physical,
               std::span<const render::View> views);

} // namespace isochron::app
