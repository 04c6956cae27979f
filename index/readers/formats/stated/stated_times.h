// Times as files state them after the CF conventions and their relatives: numbers or text, with a
// unit, a calendar and fill values, in whatever container.
#pragma once

#include "index/volume/calendar.h"
#include "index/volume/volume_series.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::index {

/// A time for each step, in their order.
struct StatedTimes {
    std::string name; ///< by which notes call them: `time`
    std::vector<double> values = {};
    std::string unit = {};     ///< `days since 2000-01-01`; `day as %Y%m%d.%f` where they are dates
    std::string calendar = {}; ///< its name in CF or FMS, in any case; empty: the usual one
    std::vector<double> missing = {}; ///< values that stand for missing ones
};

/// Sets times and their unit. The unit includes its reference date and, if it is not the usual one,
/// its calendar. Steps at the end whose times are missing are left out, so that there are fewer times
/// than there were; a missing one before them is NaN. Notes say so, and where dates are no dates.
/// @param dates order of day and month in a reference date whose year is last, where a user says it
void place_times(StatedTimes stated, SeriesInfo& info, std::optional<DayMonth> dates = {});

/// Whether texts are dates, but for those that stand for none: empty ones, `NaT`.
bool are_dates(std::span<const std::string> texts);

/// Sets times to the seconds since the first of such dates, in UTC where they have zones:
/// `2005-08-28_12:00:00`, `2005-08-28T12:00:00.5+02:00`, `28/08/2005`. Where a text is none, a note says
/// so, and there are no times; those that stand for none are left out as `place_times` does.
/// @param name by which the note calls them @param said order of day and month, where a user says it
void place_dates(std::span<const std::string> dates, const std::string& name, SeriesInfo& info,
                 std::optional<DayMonth> said = {});

} // namespace isochron::index
