// Reads the header of a classic NetCDF file, to find how long the file must be.
#pragma once

#include <filesystem>

namespace isochron::index {

/// Whether a file starts like CDF-1, CDF-2 or CDF-5.
bool is_classic_netcdf(const std::filesystem::path& path);

/// Checks that the file is as long as its header says. The library itself trusts the header's
/// counts, and gives zeros for values after the end of the file.
/// @throws Error naming the file: truncated, or the header is damaged
void expect_whole_classic_netcdf(const std::filesystem::path& path);

} // namespace isochron::index
