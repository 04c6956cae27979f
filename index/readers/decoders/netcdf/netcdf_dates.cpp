// Reads dates that are text.
#include "index/readers/decoders/netcdf/netcdf_dates.h"

#include "index/lower_case.h"
#include "index/readers/formats/stated_times.h"

#include <algorithm>
#include <string>
#include <vector>

namespace isochron::index {
namespace {

constexpr std::size_t kLongest = 64; ///< characters of a date

const NetcdfVariable* text_of_dates(const NetcdfFile& file, const NetcdfDimension& time) {
    for (const NetcdfVariable& variable : file.variables()) {
        const std::string name =
            lower_case(variable.name.substr(variable.name.rfind('/') + 1)); // npos + 1 is 0
        if (!variable.type && variable.dimensions.size() == 2 &&
            variable.dimensions.front() == time && variable.dimensions.back().length <= kLongest &&
            (name == "times" || name == "xtime") && file.is_text(variable))
            return &variable;
    }
    return nullptr;
}

} // namespace

void place_dates(const NetcdfFile& file, const NetcdfDimension& time, SeriesInfo& info) {
    const NetcdfVariable* variable = text_of_dates(file, time);
    if (!variable)
        return;
    const std::size_t length = variable->dimensions.back().length;
    std::string all(time.length * length, '\0');
    file.read(*variable, std::vector<std::size_t>(2), std::vector{time.length, length},
              std::as_writable_bytes(std::span(all)));
    std::vector<std::string> dates;
    for (std::size_t step = 0; step < time.length; ++step)
        dates.emplace_back(all.substr(step * length, length).c_str());
    place_dates(dates, variable->name, info);
}

} // namespace isochron::index
