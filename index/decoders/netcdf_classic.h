// The header of a classic NetCDF file, as far as it says how long the file must be.
#pragma once

#include <filesystem>

namespace isochron::index {

/// Whether a file starts as CDF-1, -2 or -5 do.
bool is_classic_netcdf(const std::filesystem::path& path);

/// The library takes the header's word for counts, and gives zeros for what lies behind the end of
/// the file. @throws Error naming the file: truncated, or the header is damaged
void expect_whole_classic_netcdf(const std::filesystem::path& path);

} // namespace isochron::index
