// Finds the dimensions of space and time of a NetCDF variable, and the positions of its vertices.
#pragma once

#include "index/readers/decoders/netcdf/netcdf_file.h"

#include <array>
#include <cstddef>
#include <optional>

namespace isochron::index {

struct NetcdfLayout {
    std::array<std::size_t, 3> space{};   ///< the dimensions of the index axes, fastest first
    std::array<int, 3> physical{0, 1, 2}; ///< the physical axis along which each of them runs
    bool upright = false;                 ///< physical z is known to point upwards
    std::optional<std::size_t> time;      ///< the dimension of the steps
};

/// Finds the roles of dimensions by the CF conventions (`axis`, `standard_name`, `units`,
/// `positive`), else by their names, else by their order: time slowest, x fastest. Dimensions of
/// length 1 that are not time are ignored.
/// @return none unless exactly three dimensions are left for space
std::optional<NetcdfLayout> layout_of(const NetcdfFile& file, const NetcdfVariable& variable);

/// Sets grid, unit of length, names of axes, space and notes from the coordinate variables. If axes
/// have units of different kinds, a power of ten brings them into proportion; a note says which.
/// @throws Error: coordinates that neither increase nor decrease, unless `options` have a spacing
void place_axes(const NetcdfFile& file, const NetcdfVariable& variable, const NetcdfLayout& layout,
                const ReadOptions& options, SeriesInfo& info);

/// Sets times and their unit, if a variable gives them, see `place_times`.
void place_steps(const NetcdfFile& file, const NetcdfVariable& variable, const NetcdfLayout& layout,
                 SeriesInfo& info);

} // namespace isochron::index
