// Color coordinates of cells: the places of values in a color map.
#pragma once

#include "index/surface/cell_mesh.h"
#include "index/volume/query.h"
#include "index/volume/step_values.h"

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

namespace isochron::index {

/// A color coordinate is a value's place in the range of all values, 0 to kColorSteps, or kNoColor
/// if there is no value: 13 bits.
constexpr std::uint16_t kColorSteps = 8190, kNoColor = 8191;

/// The coordinate of a value, rounded to the nearest step and clamped to the range; kNoColor for
/// NaN. If `low` and `high` are equal, it is 0.
std::uint16_t color_coordinate(double value, double low, double high);

/// Fine coordinates in the color map, for values at vertices, between which colors are
/// interpolated: 0 to kFineColorSteps, or kNoFineColor for NaN and infinities.
constexpr std::uint16_t kFineColorSteps = 65534, kNoFineColor = 65535;
std::uint16_t fine_color_coordinate(double value, double low, double high);

/// Coordinates of the second array's values on the isosurface: for each cell the mean of the values
/// at the points where the surface cuts the cell's edges, interpolated linearly. A NaN or infinite
/// value at an end of a cut edge gives kNoColor.
/// @param volume, colors of the same grid, both holding the query's step
/// @param cells active in the query
/// @param low, high range of `colors` over all steps
/// @param out as long as `cells`
/// @return false when it was stopped and `out` is incomplete
bool color_cells(const StepValues& volume, const StepValues& colors, const Query& query,
                 std::span<const CellId> cells, double low, double high,
                 std::span<std::uint16_t> out, const std::stop_token& stop = {});
/// Fine coordinates of the array's values at the eight vertices of each cell, x fastest: between
/// them the colors of an exact surface are interpolated.
/// @param out eight times as long as `cells`
void color_corners(const StepValues& colors, Instant at, std::span<const CellId> cells, double low,
                   double high, std::span<std::uint16_t> out);

/// Values of another array at the vertices of a mesh: interpolated linearly between the ends of each
/// edge.
/// @param colors which hold the ends of the edges @param first_plane z of their plane 0 among the
///        planes of the vertices
std::vector<float> values_at(const StepValues& colors, Instant at,
                             std::span<const MeshVertex> vertices, std::uint32_t first_plane);

} // namespace isochron::index
