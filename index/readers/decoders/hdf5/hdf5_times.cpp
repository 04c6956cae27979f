// Takes times from the axis of time, from groups, or from datasets beside the array.
#include "index/readers/decoders/hdf5/hdf5_times.h"

#include "index/readers/decoders/hdf5/hdf5_stated.h"
#include "index/readers/formats/stated/group_times.h"

#include <string>
#include <vector>

namespace isochron::index {

void time_hdf5(const Hdf5File& file, const Hdf5Array& array, const StatedArray& stated,
               const ArrayLayout& layout, std::size_t steps, const ReadOptions& options,
               SeriesInfo& info) {
    if (!layout.time) {
        std::vector<std::string> paths;
        for (const Hdf5Dataset& step : array.steps)
            paths.push_back(step.path);
        return place_group_times(
            paths, [&](const std::string& path) { return attributes_of(file, path); },
            [&](const std::string& group) {
                auto found = coordinates_in(file, inside(group, "time"), 1, true);
                return found ? found : coordinates_in(file, inside(group, "Time"), 1, true);
            },
            options, info);
    }
    const StatedAxis& time = stated.axes[*layout.time];
    place_steps(time, options, info);
    const std::vector<std::string> around = with_groups_around(array.steps.front().path);
    for (std::size_t i = 1; i < around.size(); ++i)
        for (const std::string& name :
             {std::string("time"), std::string("Time"), std::string("times"), std::string("Times"),
              std::string("t"), time.name})
            if (info.times.empty() && !name.empty())
                if (const auto axis = coordinates_in(file, inside(around[i], name), steps, true))
                    place_steps(*axis, options, info);
}

} // namespace isochron::index
