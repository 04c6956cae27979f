// Finds dates in names.
#include "index/readers/formats/series/dated_name.h"

#include "index/lower_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>

namespace isochron::index {
namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// Reads a name from left to right.
class NameReader {
  public:
    NameReader(std::string_view name, std::size_t at) : name_(name), at_(at) {}

    std::size_t at() const { return at_; }
    std::size_t digits() const {
        std::size_t count = 0;
        while (at_ + count < name_.size() && is_digit(name_[at_ + count]))
            ++count;
        return count;
    }
    int number(std::size_t digits) {
        int value = 0;
        for (const std::size_t end = at_ + digits; at_ < end; ++at_)
            value = 10 * value + (name_[at_] - '0');
        return value;
    }
    bool at_month() const { return month_word_at(name_, at_).has_value(); }
    /// @return the month whose word stands there, and is passed; else 0
    int take_month() {
        const auto word = month_word_at(name_, at_);
        at_ += word ? word->length : 0;
        return word ? word->month : 0;
    }
    /// @return the character, of these, that stands there, and is passed; else 0
    char take(std::string_view one_of) {
        if (at_ >= name_.size() || one_of.find(name_[at_]) == one_of.npos)
            return 0;
        return name_[at_++];
    }

  private:
    std::string_view name_;
    std::size_t at_ = 0;
};

struct NameDate {
    std::int64_t seconds = 0; ///< since 1970-01-01
    bool has_hour = false;
    bool year_first = true;
    std::size_t end = 0; ///< in the name
};

/// Seconds of the day; none: what follows the date is not one.
std::optional<int> time_of_day(NameReader& reader) {
    constexpr std::string_view kBetween = ":-_.";
    if (!reader.take("T_- "))
        return std::nullopt;
    const std::size_t row = reader.digits();
    if (row != 2 && row != 4 && row != 6)
        return std::nullopt;
    std::array<int, 3> parts{};
    std::size_t count = 0;
    for (; count < row / 2; ++count)
        parts[count] = reader.number(2);
    while (row == 2 && count < parts.size()) {
        NameReader next = reader;
        if (!next.take(kBetween) || next.digits() != 2)
            break;
        parts[count++] = next.number(2);
        reader = next;
    }
    if (parts[0] > 23 || parts[1] > 59 || parts[2] > 59)
        return std::nullopt;
    return (parts[0] * 60 + parts[1]) * 60 + parts[2];
}

constexpr int kFirstYear = 1800, kLastYear = 2199; // else a row of digits is a number

/// A number of two digits, beside a word also of one, or the word for a month; 0: neither is there.
int day_or_month(NameReader& reader, bool month, bool beside_word) {
    if (month)
        if (const int word = reader.take_month())
            return word;
    const std::size_t row = reader.digits();
    return row == 2 || (row == 1 && beside_word) ? reader.number(row) : 0;
}

/// 2020-01-31, 2020_jan: the day may be left out behind a word.
std::optional<Date> year_month_day(NameReader& reader) {
    Date date{reader.number(4), 0, 1};
    const char between = reader.take("-_.");
    if (const int word = reader.take_month()) {
        date.month = word;
        NameReader day = reader;
        if (between && day.take(std::string_view(&between, 1)) && day.digits() == 2) {
            date.day = day.number(2);
            reader = day;
        }
        return date;
    }
    if (!between || reader.digits() != 2)
        return std::nullopt;
    date.month = reader.number(2);
    if (!reader.take(std::string_view(&between, 1)) || reader.digits() != 2)
        return std::nullopt;
    date.day = reader.number(2);
    return date;
}

/// 31-01-2020, 31jan2020, jan-31-2020, jan2020.
std::optional<Date> year_last(NameReader& reader, DayMonth order) {
    Date date{0, 0, 1};
    const bool word_first = reader.at_month();
    const bool day_first = order == DayMonth::day_first && !word_first;
    NameReader behind = reader; // the first number
    behind.number(behind.digits());
    behind.take("-_./");
    const bool word = word_first || behind.at_month();
    const int first = day_or_month(reader, !day_first, word);
    const char between = reader.take("-_./");
    if (first == 0 || (!between && !word))
        return std::nullopt;
    date.month = first;
    if (!(word_first && reader.digits() == 4)) {
        // A word says by itself that it is the month.
        const bool day_was_first = day_first || (word && !word_first);
        const int second = day_or_month(reader, day_was_first, word);
        date.day = day_was_first ? first : second;
        date.month = day_was_first ? second : first;
        if (between && !reader.take(std::string_view(&between, 1)))
            return std::nullopt;
    }
    if (reader.digits() != 4)
        return std::nullopt;
    date.year = reader.number(4);
    return date.year >= kFirstYear && date.year <= kLastYear ? std::optional(date) : std::nullopt;
}

/// The date that begins at a place of a name.
std::optional<NameDate> date_at(std::string_view name, std::size_t begin, DayMonth order) {
    NameReader reader(name, begin);
    std::optional<Date> date;
    const std::size_t row = reader.digits();
    if (row == 4) {
        date = year_month_day(reader);
    } else if (row == 8) {
        date = Date{reader.number(4), 0, 0};
        date->month = reader.number(2);
        date->day = reader.number(2);
        if (date->year < kFirstYear || date->year > kLastYear)
            return std::nullopt;
    } else if (row < 3) {
        date = year_last(reader, order);
    }
    const auto day = date ? day_number(*date, Calendar::gregorian) : std::nullopt;
    if (!day)
        return std::nullopt;
    constexpr std::int64_t kDay = 86'400;
    NameDate found{*day * kDay, false, row >= 4, reader.at()};
    if (const auto seconds = time_of_day(reader)) {
        found.seconds += *seconds;
        found.has_hour = true;
        found.end = reader.at();
    }
    return found;
}

std::vector<NameDate> dates_in(const std::string& name, DayMonth order) {
    std::vector<NameDate> dates;
    for (std::size_t i = 0; i < name.size();) {
        const auto word = month_word_at(name, i);
        if (!is_digit(name[i]) && !word) {
            ++i;
        } else if (const auto date = date_at(name, i, order)) {
            dates.push_back(*date);
            i = date->end;
        } else if (word) {
            i += word->length;
        } else {
            while (i < name.size() && is_digit(name[i]))
                ++i;
        }
    }
    return dates;
}

/// The dates of each name that differ first; empty: a name has none, or none differs among several.
std::vector<NameDate> dates_that_differ(const std::vector<std::string>& names, DayMonth order) {
    std::vector<std::vector<NameDate>> dates;
    for (const std::string& name : names) {
        dates.push_back(dates_in(name, order));
        if (dates.back().empty() || dates.back().size() != dates.front().size())
            return {};
    }
    for (std::size_t i = 0; !dates.empty() && i < dates.front().size(); ++i) {
        const bool differs = std::ranges::any_of(dates, [&](const auto& of_name) {
            return of_name[i].seconds != dates.front()[i].seconds;
        });
        if (!differs && dates.size() > 1)
            continue;
        std::vector<NameDate> found;
        for (const auto& of_name : dates)
            found.push_back(of_name[i]);
        return found;
    }
    return {};
}

/// What both orders of day and month make of names.
struct BothReadings {
    std::vector<NameDate> dates; ///< empty: none
    DayMonth order = DayMonth::day_first;
    std::vector<NameDate> other = {}; ///< by month first, where both are possible and differ
};

BothReadings read_both(const std::vector<std::string>& names, std::optional<DayMonth> said) {
    if (said)
        return {dates_that_differ(names, *said), *said};
    std::vector<NameDate> day_first = dates_that_differ(names, DayMonth::day_first),
                          month_first = dates_that_differ(names, DayMonth::month_first);
    if (day_first.empty())
        return {std::move(month_first), DayMonth::month_first};
    if (std::ranges::equal(day_first, month_first, {}, &NameDate::seconds, &NameDate::seconds))
        month_first.clear();
    return {std::move(day_first), DayMonth::day_first, std::move(month_first)};
}

std::string file_name(const std::string& path) {
    return path.substr(path.rfind('/') + 1); // npos + 1 is 0
}

std::vector<std::string> texts_of(std::span<const std::filesystem::path> files) {
    std::vector<std::string> names;
    for (const std::filesystem::path& file : files)
        names.push_back(file.string());
    return names;
}

} // namespace

std::optional<MonthWord> month_word_at(std::string_view name, std::size_t at) {
    constexpr std::array<std::string_view, 12> kMonths{
        "january", "february", "march",     "april",   "may",      "june",
        "july",    "august",   "september", "october", "november", "december"};
    const auto is_letter = [&](std::size_t i) {
        return i < name.size() && (name[i] | 32) >= 'a' && (name[i] | 32) <= 'z';
    };
    if (!is_letter(at) || (at > 0 && is_letter(at - 1)))
        return std::nullopt;
    std::size_t end = at;
    while (is_letter(end))
        ++end;
    const std::string word = lower_case(std::string(name.substr(at, end - at)));
    for (std::size_t month = 0; month < kMonths.size(); ++month)
        if (word == kMonths[month] || word == kMonths[month].substr(0, 3) ||
            (word == "sept" && kMonths[month] == "september"))
            return MonthWord{static_cast<int>(month) + 1, word.size()};
    return std::nullopt;
}

std::optional<NameDates> dates_in_names(std::span<const std::filesystem::path> files,
                                        std::optional<DayMonth> said) {
    const auto [dates, order, other] = read_both(texts_of(files), said);
    if (dates.empty() || !other.empty())
        return std::nullopt;
    const bool days = std::ranges::none_of(dates, &NameDate::has_hour);
    NameDates found{{}, days ? "days since 1970-01-01" : "seconds since 1970-01-01"};
    for (const NameDate& date : dates)
        found.times.push_back(static_cast<double>(date.seconds) / (days ? 86'400 : 1));
    return found;
}

TextDates dates_of_texts(const std::vector<std::string>& texts, std::optional<DayMonth> said) {
    const BothReadings read = read_both(texts, said);
    TextDates found{.order = read.order, .open = !read.other.empty()};
    if (found.open)
        return found;
    for (const NameDate& date : read.dates) {
        found.seconds.push_back(static_cast<double>(date.seconds));
        found.year_last = found.year_last || !date.year_first;
    }
    return found;
}

DateOrder order_of_dates(const std::vector<std::string>& names, std::optional<DayMonth> said) {
    const auto order_of = [&](const std::vector<NameDate>& dates) {
        std::vector<std::size_t> order(names.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::stable_sort(order, {}, [&](std::size_t name) { return dates[name].seconds; });
        return order;
    };
    const BothReadings read = read_both(names, said);
    if (!read.other.empty())
        return {{},
                order_of(read.dates) == order_of(read.other)
                    ? ""
                    : fmt::format("the dates in the names may be day-month-year or month-day-year: "
                                  "their numbers order them as they stand ({}); --dates dmy or "
                                  "--dates mdy makes dates of them",
                                  file_name(names.front()))};
    if (read.dates.empty() || std::ranges::all_of(read.dates, &NameDate::year_first))
        return {};
    DateOrder found{order_of(read.dates), {}};
    if (names.size() > 1)
        found.note = fmt::format("the dates in the names order the steps, read as {}: {} before {}",
                                 name_of(read.order), file_name(names[found.order[0]]),
                                 file_name(names[found.order[1]]));
    return found;
}

std::string_view name_of(DayMonth order) {
    return order == DayMonth::day_first ? "day-month-year" : "month-day-year";
}

std::optional<std::string> note_on_dates(std::span<const std::filesystem::path> files,
                                         std::optional<DayMonth> said) {
    if (files.size() < 2 || !dates_in_names(files, said))
        return std::nullopt;
    return "the files' names have dates; --times-from-names takes them as times";
}

} // namespace isochron::index
