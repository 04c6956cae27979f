// What xarray's conventions, which are the CF conventions, say of an array in Zarr: coordinates,
// packing, gaps.
#pragma once

#include "index/readers/decoders/zarr/zarr_array.h"
#include "index/volume/volume_series.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::index {

/// Sets places, names and units of the axes, and times, by the arrays beside this one that have the
/// names and lengths of its dimensions. Axes without such an array stay as they are.
/// @param space its dimensions along x, y and z @param time the one of the steps
/// @throws Error naming the store: coordinates that neither rise nor fall
void place_by_coordinates(const ZarrStore& store, const ZarrArray& array,
                          const std::array<std::size_t, 3>& space, std::optional<std::size_t> time,
                          const ReadOptions& options, SeriesInfo& info);

/// `scale_factor` and `add_offset`. @throws Error naming the array: not finite, or 0
Scaling scaling_of(const ZarrArray& array, const std::string& name);

/// Values that stand for missing ones: `_FillValue`, `missing_value`, and, where dimensions have
/// names as xarray writes them, the value of chunks that were never written.
std::vector<double> missing_in(const ZarrArray& array);

/// Makes NaN, or 0 in integers, of the values that stand for missing ones.
/// @return a number for each value, not 0 if it is missing
std::vector<std::uint8_t> take_out(std::span<const double> missing, StoredType type,
                                   std::span<std::byte> values);

} // namespace isochron::index
