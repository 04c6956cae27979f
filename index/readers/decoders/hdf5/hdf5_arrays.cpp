// Groups datasets into arrays, and chooses one.
#include "index/readers/decoders/hdf5/hdf5_arrays.h"

#include "index/error.h"
#include "index/readers/decoders/hdf5/hdf5_stated.h"
#include "index/readers/formats/series/numbered_groups.h"
#include "index/readers/formats/series/numbered_name.h"
#include "index/readers/formats/stated/array_places.h"
#include "index/readers/formats/stated/group_times.h"
#include "index/readers/formats/stated/stated_attributes.h"

#include <fmt/format.h>

#include <algorithm>

namespace isochron::index {
namespace {

/// The path with its last numbered group replaced by `*`, and the end of that group in the path.
std::optional<std::pair<std::string, std::size_t>> pattern_of(const std::string& path) {
    std::size_t slash = path.rfind('/');
    while (slash != std::string::npos && slash > 0) {
        const std::size_t before = path.rfind('/', slash - 1);
        const std::size_t begin = before == std::string::npos ? 0 : before + 1;
        if (const auto number = number_at_end(std::string_view(path).substr(begin, slash - begin)))
            return std::pair(path.substr(0, begin + *number) + "*" + path.substr(slash), slash);
        slash = before;
    }
    return std::nullopt;
}

/// The part of a path that matches the pattern, up to the end of the group at the first `*`.
std::string group_in(const std::string& path, const std::string& pattern) {
    const std::size_t star = pattern.find('*');
    const auto behind = std::count(pattern.begin() + static_cast<std::ptrdiff_t>(star),
                                   pattern.end(), '/'); // slashes that follow
    std::size_t end = path.size();
    for (std::ptrdiff_t i = 0; i < behind; ++i)
        end = path.rfind('/', end - 1);
    return path.substr(0, end);
}

Hdf5Array steps_of(std::string name, const std::vector<Hdf5Dataset>& steps) {
    std::vector<std::string> paths;
    for (const Hdf5Dataset& step : steps)
        paths.push_back(step.path);
    const ReadNames read = read_names(paths);
    Hdf5Array array{.name = std::move(name), .steps = {}, .groups = {}, .note = read.note};
    for (const std::size_t step : read.order)
        array.steps.push_back(steps[step]);
    for (const Hdf5Dataset& step : array.steps)
        array.groups.push_back(group_in(step.path, array.name));
    return array;
}

/// The path of a dataset with `*` for the number of its iteration, where each has a file of its own.
/// After "openPMD - a standard", iterationEncoding `fileBased`.
std::optional<std::string> pattern_of_iteration(const Hdf5File& file, const std::string& path) {
    if (file.text("/", "openPMD").empty() || file.text("/", "iterationEncoding") != "fileBased")
        return std::nullopt;
    const auto pattern = pattern_of(path);
    return pattern ? std::optional(pattern->first) : std::nullopt;
}

/// Whether it may be a volume, by the number of its dimensions.
bool may_be_volume(const Hdf5Dataset& dataset) {
    const auto dimensions =
        std::ranges::count_if(dataset.dimensions, [](std::uint64_t length) { return length != 1; });
    return dimensions >= 3 && dimensions <= 5 && dataset.type &&
           std::ranges::find(dataset.dimensions, 0u) == dataset.dimensions.end();
}

std::vector<GroupedPath> paths_of(const std::vector<Hdf5Dataset>& datasets) {
    std::vector<GroupedPath> paths;
    for (const Hdf5Dataset& dataset : datasets)
        paths.push_back({dataset.path, dataset.type
                                           ? fmt::format("{} ({})", shape_text(dataset.dimensions),
                                                         name_of(*dataset.type))
                                           : shape_text(dataset.dimensions)});
    return paths;
}

std::vector<Hdf5Array> put_together(const Hdf5File& file,
                                    const std::vector<Hdf5Dataset>& datasets) {
    const auto has_time = [&](const std::string& group) {
        return states_time(attributes_of(file, group));
    };
    std::vector<Hdf5Array> arrays;
    for (const GroupedArray& grouped : grouped_arrays(paths_of(datasets), has_time)) {
        std::vector<Hdf5Dataset> steps;
        for (const std::size_t step : grouped.steps)
            steps.push_back(datasets[step]);
        arrays.push_back(
            steps.size() > 1
                ? steps_of(grouped.name, steps)
                : Hdf5Array{pattern_of_iteration(file, grouped.name).value_or(grouped.name),
                            std::move(steps),
                            {}});
        if (!grouped.or_else.empty())
            arrays.back().open = which_steps(grouped);
    }
    return arrays;
}

[[noreturn]] void fail_without_volumes(const Hdf5File& file,
                                       const std::vector<Hdf5Dataset>& datasets) {
    constexpr std::size_t kListed = 8;
    std::string list;
    for (std::size_t i = 0; i < std::min(kListed, datasets.size()); ++i)
        list += fmt::format("{}{} ({})", i ? ", " : ": ", datasets[i].path,
                            shape_text(datasets[i].dimensions));
    throw Error("{}: holds no dataset of numbers with three to five dimensions{}", file.name(),
                list);
}

/// The arrays whose path is `name`, or else those whose path ends in it.
std::vector<Hdf5Array> called(const std::vector<Hdf5Array>& arrays, const std::string& name) {
    std::vector<Hdf5Array> found;
    const std::string end = name.starts_with('/') ? name : "/" + name;
    for (const bool whole : {true, false}) {
        for (const Hdf5Array& array : arrays)
            if (whole ? array.name == end : array.name.ends_with(end))
                found.push_back(array);
        if (!found.empty())
            break;
    }
    return found;
}

/// As `matching_arrays`.
Hdf5Array matching(const Hdf5File& file, const std::vector<Hdf5Dataset>& datasets,
                   const std::string& pattern) {
    const std::string path = pattern.starts_with('/') ? pattern : "/" + pattern;
    std::vector<Hdf5Dataset> steps;
    for (const std::size_t step : matching_arrays(paths_of(datasets), path, file.name()).steps)
        steps.push_back(datasets[step]);
    return steps_of(pattern, steps);
}

/// @throws Error where names leave open which numbers count the steps, unless a note may say it
void expect_told(Hdf5Array& array, const Hdf5File& file, const ReadOptions& options) {
    if (array.open && !options.any_array)
        throw Error("{}: {}", file.name(), *array.open);
    if (array.open)
        array.note = array.open;
}

} // namespace

Hdf5Array choose_array(const Hdf5File& file, const ReadOptions& options) {
    if (options.array && options.array->find('*') == std::string::npos) {
        // The path may go through a link, or name a single step of several.
        const std::string path =
            options.array->starts_with('/') ? *options.array : "/" + *options.array;
        if (auto dataset = file.dataset(path))
            return {pattern_of_iteration(file, path).value_or(path), {std::move(*dataset)}, {}};
    }
    const std::vector<Hdf5Dataset> datasets = file.datasets();
    if (options.array && options.array->starts_with('/'))
        if (const auto pattern = pattern_of_iteration(file, *options.array))
            return matching(file, datasets, *pattern);
    if (options.array && options.array->find('*') != std::string::npos)
        return matching(file, datasets, *options.array);
    std::vector<Hdf5Array> offered;
    for (Hdf5Array& array : put_together(file, datasets))
        if (may_be_volume(array.steps.front()))
            offered.push_back(std::move(array));
    if (offered.empty())
        fail_without_volumes(file, datasets);
    ReadOptions asked = options;
    if (options.array)
        if (std::vector<Hdf5Array> found = called(offered, *options.array); !found.empty()) {
            if (found.size() == 1) {
                expect_told(found.front(), file, options);
                return found.front();
            }
            offered = found; // several paths have this end
            asked.array.reset();
        }
    if (options.any_array) // one that can be read before one that leaves something open
        std::ranges::stable_partition(offered, [&](const Hdf5Array& array) {
            ReadOptions strict = options;
            strict.any_array = false;
            StatedArray record = stated(file, array.steps.front(), false);
            take_axis_names(objects_of(file, array.steps.front()), record);
            return layout_of(record, strict).has_value();
        });
    std::vector<StoredArray> listed;
    for (Hdf5Array& array : offered) {
        expect_told(array, file, options);
        std::string shape = shape_text(array.steps.front().dimensions);
        if (array.steps.size() > 1)
            shape += fmt::format(", {} steps", array.steps.size());
        listed.push_back({.name = array.name,
                          .type = array.steps.front().type,
                          .shape = std::move(shape),
                          .by_pattern = true});
    }
    asked.component.reset(); // components are an axis of the dataset here
    const ChosenScalar chosen = choose_scalar(listed, asked, file.name());
    Hdf5Array found = *std::ranges::find(offered, chosen.array.name, &Hdf5Array::name);
    found.offered = chosen.offered;
    return found;
}

} // namespace isochron::index
