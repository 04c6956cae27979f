// Takes times from the axis of time, from groups, or from datasets beside the array.
#include "index/readers/decoders/hdf5/hdf5_times.h"

#include "index/readers/decoders/hdf5/hdf5_stated.h"
#include "index/readers/formats/stated/stated_times.h"

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace isochron::index {
namespace {

/// The first attribute of these objects that has `count` numbers.
std::vector<double> numbers_at(const Hdf5File& file, const std::vector<std::string>& objects,
                               std::initializer_list<const char*> names, std::size_t count) {
    for (const std::string& object : objects)
        for (const char* name : names)
            if (auto found = file.numbers(object, name); found.size() == count)
                return found;
    return {};
}

} // namespace

void time_hdf5(const Hdf5File& file, const Hdf5Array& array, const StatedArray& stated,
               const ArrayLayout& layout, std::size_t steps, const ReadOptions& options,
               SeriesInfo& info) {
    if (layout.time) {
        place_steps(stated.axes[*layout.time], options, info);
        const std::vector<std::string> around = with_groups_around(array.steps.front().path);
        for (std::size_t i = 1; i < around.size(); ++i)
            for (const char* name : {"time", "Time", "times", "t"})
                if (info.times.empty())
                    if (const auto axis =
                            coordinates_in(file, inside(around[i], name), steps, true))
                        place_steps(*axis, options, info);
        for (std::size_t i = 1; i < around.size(); ++i)
            for (const std::string& name :
                 {stated.axes[*layout.time].name, std::string("time"), std::string("Times")})
                if (const auto dates = name.empty() || !info.times.empty()
                                           ? std::vector<std::string>()
                                           : file.texts_in(inside(around[i], name));
                    dates.size() == steps)
                    place_dates(dates, name, info, options.dates);
        return;
    }
    if (array.times) { // unless attributes say more
        info.times = array.times->times;
        info.time_unit = array.times->unit;
    }
    std::vector<double> times;
    std::string of_times;
    for (const Hdf5Dataset& step : array.steps) {
        const std::vector<std::string> around = with_groups_around(step.path);
        const auto time = numbers_at(file, around, kTimeAttributes, 1);
        if (time.empty())
            return;
        const auto unit = numbers_at(file, around, {"timeUnitSI"}, 1);
        times.push_back(time.front() * (unit.empty() ? 1 : unit.front()));
        if (!unit.empty())
            of_times = "s";
    }
    // A number that is equal for all steps belongs to the group around them and is not their time.
    if (times.size() > 1 && times.front() == times.back())
        return;
    info.times = std::move(times);
    info.time_unit = of_times;
}

} // namespace isochron::index
