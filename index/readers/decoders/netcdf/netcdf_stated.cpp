// Fills the record of an array from a NetCDF file.
#include "index/readers/decoders/netcdf/netcdf_stated.h"

#include "index/lower_case.h"
#include "index/readers/formats/stated/axis_roles.h"
#include "index/readers/formats/stated/stated_attributes.h"
#include "index/readers/formats/stated/stated_values.h"

#include <fmt/format.h>

#include <span>
#include <utility>

namespace isochron::index {
namespace {

/// The name within the group.
std::string own_name(const NetcdfVariable& variable) {
    return variable.name.substr(variable.name.rfind('/') + 1); // npos + 1 is 0
}

StatedAxis coordinate_in(const NetcdfFile& file, const NetcdfVariable& variable) {
    StatedAxis axis;
    axis.coordinate = own_name(variable);
    take_cf_attributes(attributes_of(file, variable), axis);
    return axis;
}

std::vector<double> scaled_values(const NetcdfFile& file, const NetcdfVariable& variable) {
    const Scaling scaling = scaling_by(attributes_of(file, variable),
                                       fmt::format("{}: {}", file.name(), variable.name));
    std::vector<double> values = file.values(variable);
    for (double& value : values)
        value = scaling(value);
    return values;
}

} // namespace

StatedAttributes attributes_of(const NetcdfFile& file, const NetcdfVariable& variable) {
    return {.text = [&file, variable](const char* name) { return file.text(variable, name); },
            .texts = [&file, variable](const char* name) { return file.texts(variable, name); },
            .numbers = [&file, variable](const char* name) { return file.numbers(variable, name); },
            .is_real = [&file, variable](const char* name) { return file.is_real(variable, name); },
            .names = [&file, variable] { return file.attributes(variable); }};
}

std::vector<StatedAttributes> objects_of(const NetcdfFile& file, const NetcdfVariable& variable) {
    return {attributes_of(file, variable), attributes_of(file, group_of(variable))};
}

StatedArray stated(const NetcdfFile& file, const NetcdfVariable& variable, bool values) {
    StatedArray array{.file = file.name(), .name = variable.name, .axes = {}};
    for (const NetcdfDimension& dimension : variable.dimensions) {
        std::vector<const NetcdfVariable*> candidates = file.along(variable, dimension);
        std::vector<StatedAxis> coordinates;
        for (const NetcdfVariable* candidate : candidates)
            coordinates.push_back(coordinate_in(file, *candidate));
        StatedAxis axis;
        if (const auto chosen =
                coordinate_of(dimension.name, file.text(variable, "coordinates"), coordinates)) {
            axis = std::move(coordinates[*chosen]);
            if (values)
                axis.at = scaled_values(file, *candidates[*chosen]);
        }
        axis.name = dimension.name;
        axis.length = dimension.length;
        array.axes.push_back(std::move(axis));
    }
    return array;
}

std::optional<StatedAxis> time_alone(const NetcdfFile& file) {
    for (const NetcdfVariable& variable : file.variables()) {
        if (!variable.type || !variable.dimensions.empty())
            continue;
        StatedAxis axis = coordinate_in(file, variable);
        if (role_by_attributes(axis) != AxisRole::time ||
            (axis.standard_name != "time" && role_by_name(axis.coordinate) != AxisRole::time))
            continue;
        axis.at = scaled_values(file, variable);
        return axis;
    }
    return std::nullopt;
}

NetcdfDates dates_along(const NetcdfFile& file, const NetcdfDimension& time) {
    constexpr std::size_t kLongest = 64; // characters of a date
    for (const NetcdfVariable& variable : file.variables()) {
        const std::string name = lower_case(own_name(variable));
        if (variable.type || variable.dimensions.size() != 2 ||
            variable.dimensions.front() != time || variable.dimensions.back().length > kLongest ||
            (name != "times" && name != "xtime") || !file.is_text(variable))
            continue;
        const std::size_t length = variable.dimensions.back().length;
        std::string all(time.length * length, '\0');
        file.read(variable, std::vector<std::size_t>(2), std::vector{time.length, length},
                  std::as_writable_bytes(std::span(all)));
        NetcdfDates found{variable.name};
        for (std::size_t step = 0; step < time.length; ++step)
            found.dates.emplace_back(all.substr(step * length, length).c_str());
        return found;
    }
    return {};
}

} // namespace isochron::index
