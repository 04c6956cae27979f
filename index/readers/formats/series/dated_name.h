// Names with dates: `wrfout_2020-01-02_06:00:00`, `T20200102T0600.nc`.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::index {

/// Dates that names have, as times.
struct NameDates {
    std::vector<double> times; ///< times of the names, in the order given
    std::string unit; ///< `days since 1970-01-01`, or seconds where a name has a time of day
};

/// Dates are written as YYYY-MM-DD, also with `_` or `.`, or as YYYYMMDD of the years 1800 to 2199; the
/// hour, the minute and the second may follow. Of several dates in a name, the first that differs among
/// the names counts. They are of the Gregorian calendar (proleptic), as ISO 8601 has it.
/// @return none where a name has no date, or none differs among several names
std::optional<NameDates> dates_in_names(std::span<const std::filesystem::path> files);

/// A note for the user, one sentence, if the names of files without times have dates that differ.
std::optional<std::string> note_on_dates(std::span<const std::filesystem::path> files);

} // namespace isochron::index
