// A series on a regular grid of as many vertices as were asked for.
#pragma once

#include "index/volume/volume_series.h"

#include <array>
#include <cstdint>
#include <memory>

namespace isochron::index {

/// A `ReadOptions::resample`: the cells of the new grid are as small as the smallest old cell.
inline constexpr std::array<std::uint32_t, 3> kBySmallestCell{0, 0, 0};

/// Values between the vertices of `series` are interpolated along each axis; vertices of the new
/// grid are even, and the first and the last of each axis lie where they did. Values are f32, or
/// f64 where they were f64 or i32. A note tells how far the new grid is from the values at the old
/// vertices in the first step, which is read for it.
/// @param vertices along each axis, or `kBySmallestCell`
/// @return the series itself if its grid is regular and its vertices are as many as asked for
/// @throws Error: too many vertices by the smallest cell
std::unique_ptr<VolumeSeries> resampled(std::unique_ptr<VolumeSeries> series,
                                        const std::array<std::uint32_t, 3>& vertices);

} // namespace isochron::index
