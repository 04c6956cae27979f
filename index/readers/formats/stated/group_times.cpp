// Finds the times that groups state.
#include "index/readers/formats/stated/group_times.h"

#include "index/readers/formats/series/numbered_groups.h"
#include "index/readers/formats/stated/array_places.h"
#include "index/readers/formats/stated/stated_times.h"
#include "index/volume/time_unit.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

namespace isochron::index {
namespace {

/// The time that the attributes of an object state: a number with its unit, or a date; none.
std::optional<StatedAxis> time_of(const StatedAttributes& object) {
    for (const char* name : {"time", "Time", "TIME", "t"}) {
        StatedAxis time{.name = name};
        if (time.at = object.numbers(name); time.at.size() == 1) {
            const auto seconds = object.numbers("timeUnitSI"); // as openPMD has it
            time.at.front() *= seconds.size() == 1 ? seconds.front() : 1;
            time.unit = seconds.size() == 1 ? "s" : "";
            return time;
        }
        time.at.clear();
        if (time.dates = {object.text(name)}; are_dates(time.dates))
            return time;
    }
    return std::nullopt;
}

/// Converts times to the unit of those before. Times that cannot be converted are left out, so that
/// names of groups decide.
void in_unit_of(const StatedAxis& before, StatedAxis& time) {
    const std::string from = with_calendar(time.unit, time.calendar),
                      to = with_calendar(before.unit, before.calendar);
    if (before.at.empty() || before.unit.empty() || time.unit.empty() || from == to)
        return;
    time.at = times_in(to, from, std::move(time.at)).value_or(std::vector<double>());
    time.unit = before.unit;
    time.calendar = before.calendar;
}

} // namespace

bool states_time(const StatedAttributes& group) {
    return time_of(group).has_value();
}

void place_group_times(std::span<const std::string> paths,
                       const std::function<StatedAttributes(const std::string& path)>& object_at,
                       const std::function<std::optional<StatedAxis>(const std::string&)>& time_in,
                       const ReadOptions& options, SeriesInfo& info) {
    StatedAxis all;
    for (const std::string& path : paths)
        for (std::string group = path;;) {
            auto time = time_in(group);
            if (!time)
                time = time_of(object_at(group));
            if (time) {
                in_unit_of(all, *time);
                std::ranges::copy(time->at, std::back_inserter(all.at));
                std::ranges::copy(time->dates, std::back_inserter(all.dates));
                time->at.swap(all.at);
                time->dates.swap(all.dates);
                all = std::move(*time);
                break;
            }
            if (group.empty() || group == "/")
                break;
            const std::size_t slash = group.rfind('/');
            group.resize(slash == group.npos ? 0
                                             : std::max<std::size_t>(slash, path.front() == '/'));
        }
    // A time that is equal for all steps belongs to the group around them and is not theirs.
    const auto differ = [&](const auto& times) {
        return times.size() == paths.size() && (times.size() == 1 || times.front() != times.back());
    };
    if (differ(all.at) || differ(all.dates))
        return place_steps(all, options, info);
    if (const auto named = times_of_groups(paths)) {
        info.times = named->times;
        info.time_unit = named->unit;
    }
}

} // namespace isochron::index
