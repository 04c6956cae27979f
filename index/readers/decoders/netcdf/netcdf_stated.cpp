// Fills the record of an array from a NetCDF file.
#include "index/readers/decoders/netcdf/netcdf_stated.h"

#include "index/readers/formats/stated/axis_roles.h"
#include "index/readers/formats/stated/stated_attributes.h"
#include "index/readers/formats/stated/stated_times.h"
#include "index/readers/formats/stated/stated_values.h"

#include <fmt/format.h>

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

StatedAttributes attributes_of(const NetcdfFile& file, const std::string& path) {
    return attributes_of(file, file.at(path));
}

std::vector<StatedAttributes> objects_of(const NetcdfFile& file, const NetcdfVariable& variable) {
    std::vector<StatedAttributes> objects{attributes_of(file, variable)};
    for (std::string group = variable.name; !group.empty();) {
        const std::size_t slash = group.rfind('/');
        group.resize(slash == group.npos ? 0 : slash);
        objects.push_back(attributes_of(file, group));
    }
    return objects;
}

StatedArray stated(const NetcdfFile& file, const NetcdfVariable& variable, bool values) {
    StatedArray array{.file = file.name(), .name = variable.name, .axes = {}};
    for (const NetcdfDimension& dimension : variable.dimensions) {
        std::vector<const NetcdfVariable*> candidates = file.along(variable, dimension);
        std::vector<StatedAxis> coordinates;
        std::erase_if(candidates, [&](const NetcdfVariable* candidate) {
            StatedAxis axis = coordinate_in(file, *candidate);
            if (!candidate->type)
                axis.dates = file.texts(*candidate);
            if (!candidate->type &&
                (axis.dates.size() != dimension.length || !are_dates(axis.dates)))
                return true;
            coordinates.push_back(std::move(axis));
            return false;
        });
        StatedAxis axis;
        if (const auto chosen =
                coordinate_of(dimension.name, file.text(variable, "coordinates"), coordinates)) {
            axis = std::move(coordinates[*chosen]);
            if (values && axis.dates.empty())
                axis.at = scaled_values(file, *candidates[*chosen]);
        }
        axis.name = dimension.name;
        axis.length = dimension.length;
        array.axes.push_back(std::move(axis));
    }
    return array;
}

std::optional<StatedAxis> time_in(const NetcdfFile& file, const std::string& group) {
    for (const NetcdfVariable& variable : file.variables()) {
        const std::size_t slash = variable.name.rfind('/');
        if (variable.name.substr(0, slash == variable.name.npos ? 0 : slash) != group)
            continue;
        StatedAxis axis = coordinate_in(file, variable);
        const auto role = role_by_attributes(axis);
        if (axis.standard_name != "time" && !(role_by_name(axis.coordinate) == AxisRole::time &&
                                              role.value_or(AxisRole::time) == AxisRole::time))
            continue;
        const auto& along = variable.dimensions;
        if (!variable.type)
            axis.dates = file.texts(variable);
        else if (along.empty() || (along.size() == 1 && along.front().length == 1))
            axis.at = scaled_values(file, variable);
        if (axis.at.size() == 1 || (axis.dates.size() == 1 && are_dates(axis.dates)))
            return axis;
    }
    return std::nullopt;
}

} // namespace isochron::index
