// Which dimensions of a NetCDF variable are space and time, and where its vertices lie.
#pragma once

#include "index/decoders/netcdf_file.h"

#include <array>
#include <cstddef>
#include <optional>

namespace isochron::index {

struct NetcdfLayout {
    std::array<std::size_t, 3> space{};   ///< the dimensions of the index axes, fastest first
    std::array<int, 3> physical{0, 1, 2}; ///< the axis of physical space that each runs along
    bool upright = false;                 ///< known to have physical z upwards
    std::optional<std::size_t> time;      ///< the dimension of the steps
};

/// After the CF conventions (`axis`, `standard_name`, `units`, `positive`), then by the names of
/// the dimensions, then by their order: time slowest, x fastest. Dimensions of length 1 that are
/// not time count for nothing.
/// @return none when other than three dimensions are left
std::optional<NetcdfLayout> layout_of(const NetcdfFile& file, const NetcdfVariable& variable);

/// Sets grid, unit of length, space and notes from the coordinate variables. The grid is uniform:
/// vertices that are not are spread evenly between the first and the last, and a note says so. Axes
/// in units of different kinds are brought in proportion by a power of ten, and a note says which.
/// @throws Error: coordinates that do not increase or decrease; none when `options` have a spacing
void place_axes(const NetcdfFile& file, const NetcdfVariable& variable, const NetcdfLayout& layout,
                const ReadOptions& options, SeriesInfo& info);

/// Sets times and their unit, with its reference date and, where it is not the usual one, its
/// calendar, if a variable gives them.
void place_steps(const NetcdfFile& file, const NetcdfVariable& variable, const NetcdfLayout& layout,
                 SeriesInfo& info);

} // namespace isochron::index
