// Fills the record of an array by dimension scales, datasets beside it and attributes.
#include "index/readers/decoders/hdf5/hdf5_stated.h"

#include "index/readers/formats/stated/stated_attributes.h"
#include "index/readers/formats/stated/stated_times.h"
#include "index/readers/formats/stated/stated_values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>
#include <utility>

namespace isochron::index {
namespace {

std::string last_name(const std::string& path) {
    return path.substr(path.rfind('/') + 1);
}

/// The coordinates along a dimension without a scale, among the datasets that its label and the
/// attribute `coordinates` name.
std::optional<StatedAxis> named_coordinates(const Hdf5File& file, const Hdf5Dataset& dataset,
                                            const std::string& label, std::uint64_t length,
                                            bool values) {
    const std::string named = file.text(dataset.path, "coordinates");
    const std::vector<std::string> around = with_groups_around(dataset.path);
    std::vector<StatedAxis> candidates;
    std::istringstream names(label + " " + named);
    for (std::string name; names >> name;)
        for (std::size_t i = 1; i < around.size(); ++i)
            if (auto found = coordinates_in(file, inside(around[i], name), length, values)) {
                candidates.push_back(std::move(*found));
                break;
            }
    const auto chosen = coordinate_of(label, named, candidates);
    return chosen ? std::optional(candidates[*chosen]) : std::nullopt;
}

} // namespace

std::vector<std::string> with_groups_around(std::string path) {
    std::vector<std::string> objects{path};
    while (path != "/" && !path.empty()) {
        path.resize(path.rfind('/'));
        if (path.empty())
            path = "/";
        objects.push_back(path);
    }
    return objects;
}

std::string inside(const std::string& group, const std::string& name) {
    return group == "/" ? "/" + name : fmt::format("{}/{}", group, name);
}

std::optional<StatedAxis> coordinates_in(const Hdf5File& file, const std::string& path,
                                         std::uint64_t length, bool values) {
    const auto found = file.dataset(path);
    StatedAxis axis;
    axis.coordinate = last_name(path);
    axis.length = length;
    if (found && !found->type) {
        axis.dates = file.texts_in(path);
        return axis.dates.size() == length && are_dates(axis.dates) ? std::optional(axis)
                                                                    : std::nullopt;
    }
    const bool alone = found && found->dimensions.empty() && length == 1;
    if (!alone && (!found || found->dimensions != std::vector<std::uint64_t>{length}))
        return std::nullopt;
    // NetCDF-4 gives a dimension without coordinates a scale of zeros.
    if (file.text(path, "NAME").starts_with("This is a netCDF dimension but not"))
        return std::nullopt;
    const StatedAttributes attributes = attributes_of(file, path);
    take_cf_attributes(attributes, axis);
    if (!values)
        return axis;
    axis.at = file.values(*found);
    const Scaling scaling = scaling_by(attributes, fmt::format("{}: {}", file.name(), path));
    for (double& value : axis.at)
        value = scaling(value);
    return axis;
}

StatedAttributes attributes_of(const Hdf5File& file, const std::string& object) {
    return {.text = [&file, object](const char* name) { return file.text(object, name); },
            .texts = [&file, object](const char* name) { return file.texts(object, name); },
            .numbers = [&file, object](const char* name) { return file.numbers(object, name); },
            .is_real = [&file, object](const char* name) { return file.is_real(object, name); },
            .names = [&file, object] { return file.attributes(object); }};
}

std::vector<StatedAttributes> objects_of(const Hdf5File& file, const Hdf5Dataset& dataset) {
    std::vector<StatedAttributes> objects;
    for (const std::string& object : with_groups_around(dataset.path))
        objects.push_back(attributes_of(file, object));
    return objects;
}

StatedArray stated(const Hdf5File& file, const Hdf5Dataset& dataset, bool values) {
    StatedArray array{.file = file.name(), .name = dataset.path, .axes = {}};
    const std::vector<std::string> labels = file.texts(dataset.path, "DIMENSION_LABELS"),
                                   scales = file.scales(dataset);
    for (std::size_t i = 0; i < dataset.dimensions.size(); ++i) {
        const std::string label = labels.size() == dataset.dimensions.size() ? labels[i] : "";
        std::optional<StatedAxis> axis;
        if (!scales[i].empty())
            axis = coordinates_in(file, scales[i], dataset.dimensions[i], values);
        if (!axis)
            axis = named_coordinates(file, dataset, label, dataset.dimensions[i], values);
        array.axes.push_back(axis.value_or(StatedAxis{}));
        array.axes.back().name = !label.empty()       ? label
                                 : !scales[i].empty() ? last_name(scales[i])
                                                      : array.axes.back().coordinate;
        array.axes.back().length = dataset.dimensions[i];
    }
    return array;
}

void take_coordinates(const Hdf5File& file, const Hdf5Dataset& dataset, const ArrayLayout& layout,
                      StatedArray& array, std::vector<std::string>& notes) {
    const auto& space = layout.space; // fastest first
    for (const std::size_t i : space)
        if (array.axes[i].regular || !array.axes[i].at.empty())
            return;
    const std::vector<std::string> around = with_groups_around(dataset.path);
    for (std::size_t i = 1; i < around.size(); ++i) {
        std::vector<std::string> paths;
        std::vector<StatedAxis> axes;
        for (std::size_t a = 0; a < 3; ++a) // x, y, z
            for (const char* name : {"xyz", "XYZ"}) {
                const std::string path = inside(around[i], std::string(1, name[a]));
                auto found = coordinates_in(file, path, array.axes[space[a]].length, true);
                if (!found || axes.size() > a)
                    continue;
                paths.push_back(path);
                axes.push_back(std::move(*found));
            }
        if (axes.size() != 3)
            continue;
        for (std::size_t a = 0; a < 3; ++a)
            array.axes[space[a]] = std::move(axes[a]);
        notes.push_back(fmt::format("coordinates taken from {}", fmt::join(paths, ", ")));
        return;
    }
}

} // namespace isochron::index
