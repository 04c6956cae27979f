// Reads clocks.
#include "index/readers/decoders/dicom/dicom_clocks.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>

namespace isochron::index {
namespace {

const gdcm::Tag kOfFrame(0x0020, 0x9111), kOfHeart(0x0018, 0x9118), kOfBreath(0x0020, 0x9253);

/// Where a clock is read: in a group of a frame or at the root.
struct ClockSource {
    DicomClock clock;
    std::string_view unit;
    gdcm::Tag group, tag;
    gdcm::Tag date = kNoTag; ///< the date of a time of the day
};
const std::array<ClockSource, kDicomClocks - 6> kClockSources{{
    {DicomClock::time_offset, "s", {0x0020, 0x9310}, {0x0020, 0x930d}},
    {DicomClock::cardiac_delay, "ms", kOfHeart, {0x0020, 0x9153}},
    {DicomClock::trigger_time, "ms", kNoTag, {0x0018, 0x1060}},
    {DicomClock::respiratory_delay, "ms", kOfBreath, {0x0020, 0x9255}},
    {DicomClock::reference_time, "ms", kNoTag, {0x0054, 0x1300}},
    {DicomClock::cardiac_phase, "%", kOfHeart, {0x0020, 0x9241}},
    {DicomClock::respiratory_phase, "%", kOfBreath, {0x0020, 0x9245}},
    {DicomClock::temporal_index, "", kOfFrame, {0x0020, 0x9128}},
    {DicomClock::temporal_position, "", kNoTag, {0x0020, 0x0100}},
    {DicomClock::reference_moment, "s", kOfFrame, {0x0018, 0x9151}},
    {DicomClock::frame_moment, "s", kOfFrame, {0x0018, 0x9074}},
    {DicomClock::acquisition_moment, "s", kNoTag, {0x0008, 0x002a}},
    {DicomClock::acquisition_time, "s", kNoTag, {0x0008, 0x0032}, {0x0008, 0x0022}},
    {DicomClock::content_time, "s", kNoTag, {0x0008, 0x0033}, {0x0008, 0x0023}},
    {DicomClock::series_time, "s", kNoTag, {0x0008, 0x0031}, {0x0008, 0x0021}},
    {DicomClock::frame_acquisition, "", kOfFrame, {0x0020, 0x9156}},
    {DicomClock::image_index, "", kNoTag, {0x0054, 0x1330}},
    {DicomClock::acquisition, "", kNoTag, {0x0020, 0x0012}},
}};

/// Seconds of a day: `HHMMSS.FFF`, of which the end may be missing; formerly `HH:MM:SS`.
std::optional<double> seconds_of_day(std::string text) {
    std::erase(text, ':');
    if (text.size() < 2 || text.find_first_not_of("0123456789.") != text.npos ||
        std::min(text.find('.'), text.size()) % 2 != 0)
        return std::nullopt;
    const auto part = [&](std::size_t at, std::size_t size) {
        return at < text.size() ? std::stod("0" + text.substr(at, size)) : 0;
    };
    return part(0, 2) * 3600 + part(2, 2) * 60 + part(4, text.npos);
}

/// Days since 1970: `YYYYMMDD`, formerly `YYYY.MM.DD`.
std::optional<double> days_of(std::string text) {
    std::erase(text, '.');
    if (text.size() != 8 || text.find_first_not_of("0123456789") != text.npos)
        return std::nullopt;
    const auto part = [&](std::size_t at, std::size_t size) {
        return std::stoi(text.substr(at, size));
    };
    const std::chrono::year_month_day date{std::chrono::year(part(0, 4)),
                                           std::chrono::month(static_cast<unsigned>(part(4, 2))),
                                           std::chrono::day(static_cast<unsigned>(part(6, 2)))};
    if (!date.ok())
        return std::nullopt;
    return std::chrono::sys_days(date).time_since_epoch().count();
}

constexpr double kDay = 86400; ///< [s]

/// A moment, `YYYYMMDDHHMMSS.FFF+ZZZZ`. A scan stays in its zone.
std::optional<double> seconds_of_moment(const std::string& text) {
    const std::string local = text.substr(0, text.find_first_of("+-&"));
    const auto days = days_of(local.substr(0, 8));
    const auto seconds = local.size() > 8 ? seconds_of_day(local.substr(8)) : std::nullopt;
    return days && seconds ? std::optional(*days * kDay + *seconds) : std::nullopt;
}

std::optional<double> value_of(const FrameTags& tags, const ClockSource& source) {
    if (source.date != kNoTag) {
        const auto seconds = seconds_of_day(tags.text(source.group, source.tag));
        const auto days = days_of(tags.text(source.group, source.date));
        return seconds ? std::optional(*seconds + kDay * days.value_or(0)) : std::nullopt;
    }
    if (source.unit == "s" && source.clock != DicomClock::time_offset)
        return seconds_of_moment(tags.text(source.group, source.tag));
    return tags.number(source.group, source.tag);
}

} // namespace

std::string_view unit_of(DicomClock clock) {
    if (clock == DicomClock::frame_time)
        return "ms";
    if (clock == DicomClock::described_phase)
        return "%";
    const auto source = std::ranges::find(kClockSources, clock, &ClockSource::clock);
    return source == kClockSources.end() ? "" : source->unit;
}

std::string name_of(DicomClock clock, const DicomFile& file) {
    if (clock == DicomClock::frame_time || clock == DicomClock::frame_count)
        return file.frames_by;
    if (clock == DicomClock::dimension)
        return file.dimensions_by;
    if (clock == DicomClock::described_phase || clock == DicomClock::described_number)
        return "phase";
    const auto source = std::ranges::find(kClockSources, clock, &ClockSource::clock);
    return keyword_of(source == kClockSources.end() ? gdcm::Tag(0x0020, 0x0013) : source->tag);
}

void read_clocks(const FrameTags& tags, DicomImage& image) {
    for (const ClockSource& source : kClockSources)
        if (const auto value = value_of(tags, source); value && std::isfinite(*value))
            image.clock(source.clock) = value;
}

std::vector<gdcm::Tag> tags_of_clocks() {
    std::vector<gdcm::Tag> tags;
    for (const ClockSource& source : kClockSources)
        tags.push_back(source.tag);
    return tags;
}

} // namespace isochron::index
