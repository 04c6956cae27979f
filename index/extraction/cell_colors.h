// Values to color cells by, as coordinates in a color map.
#pragma once

#include "index/volume/query.h"
#include "index/volume/step_values.h"

#include <cstdint>
#include <span>
#include <stop_token>

namespace isochron::index {

/// A color coordinate is a value's place in the range of all values, 0 to kColorSteps, or
/// kNoColor where there is none: 13 bits.
constexpr std::uint16_t kColorSteps = 8190, kNoColor = 8191;

/// Rounded to the nearest step and cut to the range; kNoColor for NaN. A range of no width has
/// only the coordinate 0.
std::uint16_t color_coordinate(double value, double low, double high);

/// Coordinates of the second array's values on the isosurface: for each cell the mean over the
/// points where the surface cuts the cell's edges, at which values are interpolated linearly. A NaN
/// or infinite value at the end of an edge that is cut makes that kNoColor.
/// @param volume, colors of the same grid, both holding the query's step
/// @param cells active in the query
/// @param low, high range of `colors` over all steps
/// @param out as long as `cells`
/// @return false when it was stopped and `out` is incomplete
bool color_cells(const StepValues& volume, const StepValues& colors, const Query& query,
                 std::span<const CellId> cells, double low, double high,
                 std::span<std::uint16_t> out, const std::stop_token& stop = {});

} // namespace isochron::index
