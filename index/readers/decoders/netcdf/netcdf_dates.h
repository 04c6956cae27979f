// Times that are written as dates, as in files of WRF.
#pragma once

#include "index/readers/decoders/netcdf/netcdf_file.h"
#include "index/volume/volume_series.h"

namespace isochron::index {

/// Sets the times from a variable of text with a date for each step, `Times` (WRF) or `xtime`
/// (MPAS): `2005-08-28_12:00:00`. They are seconds since the first. Where the text is no date, a
/// note says so.
void place_dates(const NetcdfFile& file, const NetcdfDimension& time, SeriesInfo& info);

} // namespace isochron::index
