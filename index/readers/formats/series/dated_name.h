// Names with dates: `wrfout_2020-01-02_06:00:00`, `T20200102T0600.nc`, `scan_31-01-2020`.
#pragma once

#include "index/volume/calendar.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::index {

/// Dates that names have, as times.
struct NameDates {
    std::vector<double> times; ///< times of the names, in the order given
    std::string unit; ///< `days since 1970-01-01`, or seconds where a name has a time of day
};

/// Dates are written as YYYY-MM-DD, also with `_` or `.`, or as YYYYMMDD of the years 1800 to 2199; as
/// DD-MM-YYYY or MM-DD-YYYY, where a number beyond 12 in one of the names tells which; or with a word
/// for the month: 31Jan2020, jan-2020. The hour, the minute and the second may follow. Of several dates
/// in a name, the first that differs among the names counts. They are of the Gregorian calendar
/// (proleptic), as ISO 8601 has it.
/// @param said the order of day and month, where a user says it
/// @return none where a name has no date, none differs among several names, or two readings differ
std::optional<NameDates> dates_in_names(std::span<const std::filesystem::path> files,
                                        std::optional<DayMonth> said = {});

/// Texts of a file that are dates, written as in names.
struct TextDates {
    std::vector<double> seconds = {}; ///< since 1970-01-01; empty: one is no date, or they are open
    DayMonth order = DayMonth::day_first; ///< in which they were read
    bool year_last = false;               ///< in one of them
    bool open = false; ///< either order of day and month is possible, and they differ
};
TextDates dates_of_texts(const std::vector<std::string>& texts, std::optional<DayMonth> said);

/// `day-month-year`
std::string_view name_of(DayMonth order);

/// The place of the month, from 1, whose English name or first three letters begin there as a word of
/// its own: 2 of `clim_Feb.nc` at 5; and the length of the word. None: there is no month.
struct MonthWord {
    int month = 0;
    std::size_t length = 0;
};
std::optional<MonthWord> month_word_at(std::string_view name, std::size_t at);

/// The order of names by their dates, where the numbers in them would give another: of dates with the
/// year behind the month.
struct DateOrder {
    std::vector<std::size_t> order; ///< empty: that of the numbers
    std::string note;               ///< one sentence for the user; may be empty
};
DateOrder order_of_dates(const std::vector<std::string>& names, std::optional<DayMonth> said = {});

/// A note for the user, one sentence, if the names of files without times have dates that differ.
std::optional<std::string> note_on_dates(std::span<const std::filesystem::path> files,
                                         std::optional<DayMonth> said = {});

} // namespace isochron::index
