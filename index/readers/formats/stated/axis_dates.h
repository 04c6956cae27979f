// Times that are written as dates, as in files of WRF.
#pragma once

#include "index/volume/volume_series.h"

#include <string>
#include <vector>

namespace isochron::index {

/// Sets the times from a date as text for each step: `2005-08-28_12:00:00`. They are seconds since
/// the first. Where a text is no date, a note says so.
/// @param name of the variable that has them, for the note
void place_text_dates(const std::string& name, const std::vector<std::string>& dates,
                      SeriesInfo& info);

/// Whether a unit says that numbers are dates, as in CDO's absolute time axes: `day as %Y%m%d.%f`.
bool says_dates(const std::string& unit);

/// Makes times of such numbers: days since the first. Where one is no date, steps keep the numbers, and
/// a note says so.
void place_absolute_dates(std::vector<double> numbers, const std::string& unit,
                          const std::string& calendar, SeriesInfo& info);

} // namespace isochron::index
