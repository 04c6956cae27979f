// Finds dates in names.
#include "index/readers/formats/series/dated_name.h"

#include "index/volume/calendar.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

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

/// The date that begins at a place of a name.
std::optional<NameDate> date_at(std::string_view name, std::size_t begin) {
    NameReader reader(name, begin);
    Date date;
    const std::size_t row = reader.digits();
    if (row == 4) {
        date.year = reader.number(4);
        const char between = reader.take("-_.");
        if (!between || reader.digits() != 2)
            return std::nullopt;
        date.month = reader.number(2);
        if (reader.take(std::string_view(&between, 1)) == 0 || reader.digits() != 2)
            return std::nullopt;
        date.day = reader.number(2);
    } else if (row == 8) {
        date = {reader.number(4), 0, 0};
        date.month = reader.number(2);
        date.day = reader.number(2);
        constexpr int kFirst = 1800, kLast = 2199; // else a row of digits is a number
        if (date.year < kFirst || date.year > kLast)
            return std::nullopt;
    } else {
        return std::nullopt;
    }
    const auto day = day_number(date, Calendar::gregorian);
    if (!day)
        return std::nullopt;
    constexpr std::int64_t kDay = 86'400;
    NameDate found{*day * kDay, false, reader.at()};
    if (const auto seconds = time_of_day(reader)) {
        found.seconds += *seconds;
        found.has_hour = true;
        found.end = reader.at();
    }
    return found;
}

std::vector<NameDate> dates_in(const std::string& name) {
    std::vector<NameDate> dates;
    for (std::size_t i = 0; i < name.size();) {
        if (!is_digit(name[i])) {
            ++i;
        } else if (const auto date = date_at(name, i)) {
            dates.push_back(*date);
            i = date->end;
        } else {
            while (i < name.size() && is_digit(name[i]))
                ++i;
        }
    }
    return dates;
}

} // namespace

std::optional<NameDates> dates_in_names(std::span<const std::filesystem::path> files) {
    std::vector<std::vector<NameDate>> dates;
    for (const std::filesystem::path& file : files) {
        dates.push_back(dates_in(file.string()));
        if (dates.back().empty() || dates.back().size() != dates.front().size())
            return std::nullopt;
    }
    if (dates.empty())
        return std::nullopt;
    for (std::size_t i = 0; i < dates.front().size(); ++i) {
        const bool differs = std::ranges::any_of(dates, [&](const auto& of_name) {
            return of_name[i].seconds != dates.front()[i].seconds;
        });
        if (!differs && dates.size() > 1)
            continue;
        const bool days =
            std::ranges::none_of(dates, [&](const auto& of_name) { return of_name[i].has_hour; });
        NameDates found{{}, days ? "days since 1970-01-01" : "seconds since 1970-01-01"};
        for (const auto& of_name : dates)
            found.times.push_back(static_cast<double>(of_name[i].seconds) / (days ? 86'400 : 1));
        return found;
    }
    return std::nullopt;
}

std::optional<std::string> note_on_dates(std::span<const std::filesystem::path> files) {
    if (files.size() < 2 || !dates_in_names(files))
        return std::nullopt;
    return "the files' names have dates; --times-from-names takes them as times";
}

} // namespace isochron::index
