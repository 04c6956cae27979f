// Texts and dates of Zarr arrays.
//
// NumPy's datetime64: https://numpy.org/doc/stable/reference/arrays.datetime.html; numcodecs' VLenUTF8:
// https://numcodecs.readthedocs.io/en/stable/other/vlen.html.
#include "index/error.h"
#include "index/readers/decoders/zarr/zarr_array.h"
#include "index/readers/formats/text_header.h"
#include "index/volume/calendar.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <string_view>

namespace isochron::index {
namespace {

/// A unit of datetime64: months, or seconds, or parts of a second.
struct DateUnit {
    std::string_view name;
    std::int64_t months = 0, seconds = 0;
    int digits = 0; ///< digits behind the second
};
constexpr std::array<DateUnit, 14> kDateUnits{{{"Y", 12},
                                               {"M", 1},
                                               {"W", 0, 604800},
                                               {"D", 0, 86400},
                                               {"h", 0, 3600},
                                               {"m", 0, 60},
                                               {"s", 0, 1},
                                               {"ms", 0, 0, 3},
                                               {"us", 0, 0, 6},
                                               {"\xce\xbcs", 0, 0, 6},
                                               {"ns", 0, 0, 9},
                                               {"ps", 0, 0, 12},
                                               {"fs", 0, 0, 15},
                                               {"as", 0, 0, 18}}};

/// A count of units since 1970 as ISO 8601 has it; empty: it is no time, or none of the calendar.
std::string text_of_date(std::int64_t count, const DateUnit& unit, std::int64_t factor) {
    if (count == std::numeric_limits<std::int64_t>::min() || factor <= 0 ||
        __builtin_mul_overflow(count, factor, &count))
        return {};
    const auto floored = [](std::int64_t number, std::int64_t by) {
        return number / by - (number % by < 0);
    };
    constexpr std::int64_t kDay = 86400;
    std::int64_t seconds = 0, part = 0;
    std::optional<std::int64_t> day;
    if (unit.months > 0) {
        if (__builtin_mul_overflow(count, unit.months, &count) || count < -1'000'000 ||
            count > 1'000'000)
            return {};
        const std::int64_t years = floored(count, 12);
        day = day_number({static_cast<int>(1970 + years), static_cast<int>(count - 12 * years) + 1},
                         Calendar::gregorian);
    } else if (unit.digits > 0) {
        std::int64_t parts = 1;
        for (int i = 0; i < unit.digits; ++i)
            parts *= 10;
        seconds = floored(count, parts);
        part = (count % parts + parts) % parts;
        day = floored(seconds, kDay);
    } else if (!__builtin_mul_overflow(count, unit.seconds, &seconds)) {
        day = floored(seconds, kDay);
    }
    const auto date = day ? date_of(*day, Calendar::gregorian) : std::nullopt;
    if (!date)
        return {};
    const std::int64_t of_day = unit.months > 0 ? 0 : seconds - *day * kDay;
    std::string text = fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}", date->year, date->month,
                                   date->day, of_day / 3600, of_day / 60 % 60, of_day % 60);
    return unit.digits > 0 ? fmt::format("{}.{:0{}}", text, part, unit.digits) : text;
}

template <class T>
T value_at(const ZarrBytes& bytes, std::size_t at) {
    T value{};
    std::memcpy(&value, &bytes[at], sizeof(T));
    return value;
}

} // namespace

/// Characters beyond ASCII, which no date has, become `?` where they are stored as UTF-32.
std::vector<std::string> ZarrArray::texts_in(const ZarrBytes& chunk,
                                             const std::string& name) const {
    std::vector<std::string> texts;
    if (said_.texts == ZarrTexts::varying) {
        std::size_t at = 4;
        while (chunk.size() >= at + 4) {
            const auto length = value_at<std::uint32_t>(chunk, at);
            at += 4;
            if (length > chunk.size() - at)
                throw Error("{}: a text of {} bytes, {} are left", name, length, chunk.size() - at);
            texts.emplace_back(reinterpret_cast<const char*>(chunk.data()) + at, length);
            at += length;
        }
        return texts;
    }
    const auto unit = std::ranges::find(kDateUnits, said_.date_unit, &DateUnit::name);
    for (std::size_t at = 0; at < chunk.size(); at += said_.text_bytes) {
        std::string text;
        if (said_.texts == ZarrTexts::dates && unit != kDateUnits.end())
            text = text_of_date(value_at<std::int64_t>(chunk, at), *unit, said_.date_factor);
        else if (said_.texts == ZarrTexts::bytes)
            text.assign(reinterpret_cast<const char*>(chunk.data()) + at, said_.text_bytes);
        else if (said_.texts == ZarrTexts::utf32)
            for (std::size_t i = 0; i < said_.text_bytes; i += 4) {
                const auto character = value_at<std::uint32_t>(chunk, at + i);
                text += character < 128 ? static_cast<char>(character) : '?';
            }
        text.resize(std::min(text.find('\0'), text.size()));
        texts.emplace_back(trimmed(text));
    }
    return texts;
}

std::vector<std::string> ZarrArray::texts() {
    constexpr std::uint64_t kMost = 1 << 20;
    const std::uint64_t count = said_.shape.empty() ? 1 : said_.shape.front();
    if (said_.texts == ZarrTexts::none || said_.shape.size() > 1 || count > kMost ||
        values_in_chunk() > kMost || values_in_chunk() * said_.element() > kMostTexts)
        return {};
    expect_known_codecs();
    const std::size_t of_chunk = values_in_chunk();
    std::vector<std::string> all;
    for (std::uint64_t at = 0; all.size() < count; ++at) {
        ZarrBytes chunk;
        const std::vector<std::uint64_t> place(said_.shape.size(), at);
        load(place, chunk);
        std::vector<std::string> texts = texts_in(chunk, key_of(place));
        texts.resize(of_chunk); // what was never written is empty
        all.insert(all.end(), texts.begin(), texts.end());
    }
    all.resize(count);
    return all;
}

} // namespace isochron::index
