// Orders steps by the first clock that tells them apart.
#include "index/readers/decoders/dicom/dicom_times.h"

#include "index/error.h"
#include "index/readers/decoders/dicom/dicom_clocks.h"
#include "index/readers/formats/unread_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

namespace isochron::index {
namespace {

/// A scan that goes on past midnight, with the date of its beginning or without any.
void pass_midnight(std::vector<DicomSlice>& slices, DicomClock clock, DicomTimes& found) {
    constexpr double kSeconds = 86400; // in a day
    std::set<double> all;
    for (const DicomSlice& slice : slices)
        for (const DicomImage& image : slice)
            if (image.clock(clock))
                all.insert(*image.clock(clock));
    const auto after = std::ranges::adjacent_find(
        all, [](double one, double next) { return next - one > kSeconds / 2; });
    if (after == all.end() ||
        std::floor(*all.begin() / kSeconds) != std::floor(*all.rbegin() / kSeconds))
        return;
    for (DicomSlice& slice : slices)
        for (DicomImage& image : slice)
            if (image.clock(clock) && *image.clock(clock) <= *after)
                *image.clock(clock) += kSeconds;
    found.notes.push_back(
        "its clock passes midnight: the earliest times are those of the next day");
}

/// Whether it gives every image at a place another value.
bool tells_apart(const std::vector<DicomSlice>& slices, DicomClock clock) {
    return std::ranges::all_of(slices, [&](const DicomSlice& slice) {
        std::set<double> values;
        return std::ranges::all_of(slice, [&](const DicomImage& image) {
            const auto& value = image.clock(clock);
            return value && values.insert(*value).second;
        });
    });
}

/// [s] that pass at the first place.
double span_of(const std::vector<DicomSlice>& slices, DicomClock clock) {
    std::vector<double> values;
    for (const DicomImage& image : slices.front())
        values.push_back(*image.clock(clock));
    const auto [first, last] = std::ranges::minmax(values);
    return (last - first) * (unit_of(clock) == "ms" ? 1e-3 : 1);
}

/// The first clock that tells all images apart. Of a scan of many heartbeats, the delays after each
/// vary a little, and order nothing.
std::optional<DicomClock> ordering_clock(const std::vector<DicomSlice>& slices) {
    const auto of_heartbeats = [&](DicomClock clock) {
        constexpr double kMany = 10;
        return (clock == DicomClock::trigger_time || clock == DicomClock::cardiac_delay) &&
               std::ranges::any_of(
                   std::array{DicomClock::frame_moment, DicomClock::acquisition_moment,
                              DicomClock::acquisition_time},
                   [&](DicomClock scan) {
                       return tells_apart(slices, scan) &&
                              span_of(slices, scan) > kMany * span_of(slices, clock);
                   });
    };
    for (std::size_t i = 0; i < kDicomClocks; ++i)
        if (const auto clock = static_cast<DicomClock>(i);
            tells_apart(slices, clock) && !of_heartbeats(clock))
            return clock;
    return std::nullopt;
}

/// The mean over the slices of each step; empty where means do not increase.
std::vector<double> means_of(const std::vector<DicomSlice>& slices, DicomClock clock) {
    std::vector<double> means;
    for (std::size_t step = 0; step < slices.front().size(); ++step) {
        double sum = 0;
        for (const DicomSlice& slice : slices) {
            if (!slice[step].clock(clock))
                return {};
            // From the first on, as the digits of dates leave few for parts of seconds.
            sum += *slice[step].clock(clock) - *slices.front().front().clock(clock);
        }
        constexpr double kFraction = 1e6; // what a time can have
        means.push_back(std::round(sum / static_cast<double>(slices.size()) * kFraction) /
                        kFraction);
        if (step > 0 && !(means[step] > means[step - 1]))
            return {};
    }
    const bool of_calendar = unit_of(clock) == "s" && clock != DicomClock::time_offset;
    const double first = of_calendar ? -means.front() : *slices.front().front().clock(clock);
    for (double& mean : means)
        mean += first;
    return means;
}

/// Times of steps that are in order: those of the clock itself, or what else is said of them.
void give_dicom_times(const std::vector<DicomSlice>& slices, DicomClock clock,
                      const DicomFile& file, DicomTimes& found) {
    const std::string by = name_of(clock, file);
    std::string times_by;
    const auto take = [&](std::vector<double> times, std::string_view unit, std::string_view from) {
        found.times = std::move(times);
        found.unit = unit;
        times_by = from;
    };
    const bool position =
        clock == DicomClock::temporal_index || clock == DicomClock::temporal_position;
    std::vector<double> own = means_of(slices, clock);
    if (!unit_of(clock).empty()) {
        take(own, unit_of(clock), by);
    } else if (position && file.temporal_resolution > 0) {
        for (double& time : own)
            time *= file.temporal_resolution;
        take(own, "ms", "TemporalResolution");
    } else if (clock != DicomClock::dimension) {
        for (const DicomClock other :
             {DicomClock::reference_moment, DicomClock::frame_moment,
              DicomClock::acquisition_moment, DicomClock::acquisition_time})
            if (auto times = means_of(slices, other); found.times.empty() && !times.empty())
                take(std::move(times), unit_of(other), name_of(other, file));
        std::vector<double> starts, repetitions;
        double start = 0;
        for (const DicomImage& image : slices.front()) {
            repetitions.push_back(static_cast<double>(starts.size()) * file.repetition_time);
            starts.push_back(start);
            start += image.duration > 0 ? image.duration : NAN;
        }
        if (found.times.empty() && std::isfinite(start))
            take(starts, "ms", "ActualFrameDuration");
        if (found.times.empty() && file.repetition_time > 0)
            take(repetitions, "ms", "RepetitionTime");
        if (found.times.empty() &&
            (position || clock == DicomClock::frame_count || clock == DicomClock::described_number))
            take(own, "", by);
    }
    std::string note = "steps by " + by;
    if (clock == DicomClock::dimension)
        note += ", which is no time";
    else if (times_by.empty())
        note += " alone: images at the same place are taken for steps in time";
    else if (times_by != by)
        note += ", times by " + times_by;
    std::vector<std::string> unread;
    const bool lasting = std::ranges::any_of(
        slices.front(), [](const DicomImage& image) { return image.duration > 0; });
    for (const auto& [stated, name] : {std::pair(lasting, "ActualFrameDuration"),
                                       std::pair(file.repetition_time > 0, "RepetitionTime")})
        if (stated && times_by != name)
            unread.emplace_back(name);
    if (auto unused = note_on_unread(unread))
        found.notes.push_back(std::move(*unused));
    found.notes.push_back(std::move(note));
}

} // namespace

DicomTimes sort_times(std::vector<DicomSlice>& slices, const DicomFile& file,
                      const std::vector<std::string>& names) {
    const DicomSlice& first = slices.front();
    for (const DicomSlice& slice : slices)
        if (slice.size() != first.size())
            throw Error("{}: {} images at its place, {} has {} at its own",
                        names[slice.front().file], slice.size(), names[first.front().file],
                        first.size());
    DicomTimes found;
    if (first.size() == 1)
        return found;
    for (const DicomClock clock :
         {DicomClock::acquisition_time, DicomClock::content_time, DicomClock::series_time})
        pass_midnight(slices, clock, found);
    const auto clock = ordering_clock(slices);
    if (!clock)
        throw Error("{}, {}: images of the same place that neither time nor number tells apart",
                    names[first[0].file], names[first[1].file]);
    for (DicomSlice& slice : slices)
        std::ranges::sort(slice, {}, [&](const DicomImage& image) { return *image.clock(*clock); });
    give_dicom_times(slices, *clock, file, found);
    return found;
}

} // namespace isochron::index
