// Opens files as a series: lists of files, slices, parts, or a file for each step.
#include "index/readers/formats/open_series.h"
#include "index/error.h"
#include "index/readers/formats/data_stream.h"
#include "index/readers/formats/foreign_file.h"
#include "index/readers/formats/foreign_names.h"
#include "index/readers/formats/format.h"
#include "index/readers/formats/series/dated_name.h"
#include "index/readers/formats/series/derived_series.h"
#include "index/readers/formats/series/file_series.h"
#include "index/readers/formats/series/folder_files.h"
#include "index/readers/formats/series/joined_blocks.h"
#include "index/readers/formats/series/numbered_groups.h"
#include "index/readers/formats/series/numbered_name.h"
#include "index/readers/formats/series/resampled_series.h"
#include "index/readers/formats/series/step_order.h"
#include "index/readers/formats/series/vector_arrays.h"
#include "index/readers/process/reader_pool.h"
#include "index/system/input_file.h"
#include "index/volume/time_unit.h"

#include <fmt/format.h>

#include <algorithm>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

/// @param time that a list or the file's name gives
SeriesFile series_file(const KnownFile& file, const ReadOptions& options,
                       std::optional<double> time = {}) {
    file_bytes(file.path);
    // Raw data may have any name and any first bytes; giving dimensions says that a file is raw.
    const bool is_named = file.end || file.given != file.path;
    if (options.dims && !is_named)
        return {file.path, opener_of(format_named("raw")), time};
    FileStart start(file.path);
    const Format* format = file.format;
    if (format && format->headerless && !options.dims)
        if (const Format* told = told_by_content(start))
            format = told;
    if (format && !format->list)
        return {file.path, opener_of(*format), time};
    if (const std::string foreign = foreign_format_or_name(start); !foreign.empty())
        throw Error("{}: {}", file.path.string(), foreign);
    throw Error("{}: unknown format, expected one of {}, or raw values with --dims and --type",
                file.path.string(), known_extensions());
}

/// The unit of time behind the number that differs: `t_10s.vti`.
std::optional<std::string> unit_in_names(const std::vector<fs::path>& names) {
    std::vector<std::string> without_ends;
    for (const fs::path& name : names) {
        const bool is_end = name.extension().string().find_first_of("0123456789") != 1;
        without_ends.push_back((is_end ? fs::path(name).replace_extension() : name).string());
    }
    const auto times = times_of_groups(without_ends);
    return times && !times->unit.empty() ? std::optional(times->unit) : std::nullopt;
}

/// Orders files by the dates in their names, which are their times, or else by the numbers.
/// @param options get the unit of dates
std::vector<SeriesFile> timed_by_name(const std::vector<KnownFile>& files, ReadOptions& options) {
    if (options.time_step)
        throw Error("--times-from-names and --time-step: expected one of the two");
    std::vector<fs::path> names;
    for (const KnownFile& file : files)
        names.push_back(file.given);
    std::vector<std::optional<double>> times;
    if (const auto dates = dates_in_names(names, options.dates)) {
        if (!options.time_unit)
            options.time_unit = dates->unit;
        const auto wanted = times_in(*options.time_unit, dates->unit, dates->times);
        if (!wanted)
            throw Error("--time-unit: {}, expected a unit with a date for the dates of "
                        "--times-from-names, as in `hours since 2000-01-01`",
                        *options.time_unit);
        times.assign(wanted->begin(), wanted->end());
    } else {
        times = times_in_names(names);
        if (!options.time_unit)
            options.time_unit = unit_in_names(names);
    }
    std::vector<SeriesFile> series;
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (!times[i])
            throw Error(
                "{}: no number in its name, expected one for --times-from-names, as in t_0030.vti",
                names[i].string());
        series.push_back(series_file(files[i], options, times[i]));
    }
    std::ranges::stable_sort(series, {}, &SeriesFile::time);
    return series;
}

/// Files of the same time, one behind the other, are parts of a volume.
std::vector<SeriesFile> joined_by_time(std::vector<SeriesFile> files) {
    std::vector<SeriesFile> joined;
    for (auto file = files.begin(); file != files.end();) {
        const auto end = std::find_if(
            file, files.end(), [&](const SeriesFile& other) { return other.time != file->time; });
        std::vector<SeriesFile> parts(file, end);
        joined.push_back(parts.front());
        if (parts.size() > 1)
            joined.back().open = [parts = std::move(parts)](const fs::path&,
                                                            const ReadOptions& options) {
                return join_blocks(parts, options);
            };
        file = end;
    }
    return joined;
}

/// Leaves out the last steps of a list whose files are not there, as where a run was stopped; a step of
/// which only some files are there stays. A note says so.
ListedFiles without_missing_end(ListedFiles listed, const std::string& name,
                                std::vector<std::string>& notes) {
    std::error_code ignored;
    std::size_t there = listed.size();
    while (there > 0 && !fs::exists(listed[there - 1].path, ignored))
        --there;
    if (there == 0 || there == listed.size() || listed[there - 1].time == listed[there].time)
        return listed;
    notes.push_back(fmt::format("{} names {} files, of which the last {} {} not there, {} and on: "
                                "left out",
                                name, listed.size(), listed.size() - there,
                                listed.size() - there == 1 ? "is" : "are",
                                listed[there].path.filename().string()));
    listed.resize(there);
    return listed;
}

/// What a list names.
/// @param notes get how many entries there are twice, and which are left out
std::vector<SeriesFile> listed_in(const KnownFile& list, const ReadOptions& options,
                                  std::vector<std::string>& notes) {
    if (options.times_from_names)
        throw Error("{}: gives the times itself, --times-from-names cannot", list.path.string());
    file_bytes(list.path);
    std::vector<SeriesFile> series;
    std::vector<KnownFile> known;
    const ListedFiles listed = without_missing_end(
        ordered_entries(list.format->list(list.path), options.keep_first, notes),
        list.path.filename().string(), notes);
    for (const ListedFile& file : listed)
        known.push_back(known_file(file.path));
    let_readers_read(known);
    for (std::size_t i = 0; i < listed.size(); ++i)
        series.push_back(series_file(known[i], options, listed[i].time));
    return list.format->lists_parts ? joined_by_time(std::move(series)) : series;
}

/// The format that puts all the files together; null: none does.
const Format* joining_format(const std::vector<KnownFile>& files, const ReadOptions& options) {
    for (const Format& format : all_formats()) {
        // Dimensions say that files are raw, whatever the first bytes look like.
        if (format.join && std::ranges::all_of(files, [&](const KnownFile& file) {
                return options.dims ? file.format == &format && file.end
                                    : is_of_format(format, file);
            }))
            return &format;
    }
    return nullptr;
}

/// The steps of a series and the files of each.
/// @param options get what the names of the files tell
/// @param notes get what a user should know of their order
std::vector<SeriesFile> series_of(const std::vector<KnownFile>& files, ReadOptions& options,
                                  std::vector<std::string>& notes) {
    if (files.empty())
        throw Error("no files given");
    const auto list = std::ranges::find_if(
        files, [](const KnownFile& file) { return file.format && file.format->list; });
    if (list != files.end() && files.size() != 1)
        throw Error(
            "{}: names its files itself, and {} more {} given: give it alone, or leave it out",
            list->path.string(), files.size() - 1, files.size() == 2 ? "is" : "are");
    if (list != files.end())
        return listed_in(*list, options, notes);
    if (options.times_from_names)
        return timed_by_name(files, options);
    std::vector<fs::path> paths;
    std::vector<std::string> names;
    for (const KnownFile& file : files) {
        paths.push_back(file.path);
        names.push_back(file.path.string());
    }
    const Format* joining = joining_format(files, options);
    const ReadNames read = read_names(names, options.dates);
    if (read.note && (!joining || joining->joins_by_names))
        notes.push_back(*read.note);
    if (joining)
        return joining->join(*joining, paths, options);
    std::vector<SeriesFile> series;
    for (const std::size_t file : read.order)
        series.push_back(series_file(files[file], options));
    return series;
}

std::unique_ptr<VolumeSeries> open_as_it_is(const std::vector<fs::path>& given, ReadOptions options,
                                            const Progress& progress) {
    const FoundFiles found = found_files(given, options);
    let_readers_read(found.files);
    std::vector<std::string> notes;
    if (found.note)
        notes.push_back(*found.note);
    std::vector<SeriesFile> files = series_of(found.files, options, notes);
    return open_file_series(std::move(files), options, notes, progress);
}

/// Whether there is an array of exactly this name.
bool holds_array(const OpenStored& open, ReadOptions options, const std::string& name) {
    options.array.reset();
    options.component.reset();
    options.any_array = true;
    try {
        return std::ranges::any_of(open(options)->info().arrays, [&](const std::string& offered) {
            return offered.starts_with(name + " (");
        });
    } catch (const Error&) {
        return false;
    }
}

/// What is computed of a vector whose components are the arrays of a list.
std::unique_ptr<VolumeSeries> open_vector(const OpenStored& open, const std::string& name,
                                          const ReadOptions& options,
                                          const std::vector<std::string>& names) {
    const std::string component = options.component.value_or("magnitude");
    const auto derived = derived_from_name(component);
    if (derived ? *derived == Derived::gradient || names.size() != 3 : component != "magnitude")
        throw Error("--component {} of {}, expected magnitude{}", component, *options.array,
                    names.size() == 3 ? ", vorticity or q-criterion" : "");
    auto inputs = open_components(names, [&](const std::string& of_one) {
        ReadOptions of_input = options;
        of_input.array = of_one;
        of_input.component.reset();
        of_input.value_unit.reset(); // it is the result's
        return open_stored_series(open, name, of_input);
    });
    return derived_series(std::move(inputs), derived.value_or(Derived::magnitude), *options.array,
                          options.value_unit);
}

/// @param open_first what is read first, which has all arrays
std::unique_ptr<VolumeSeries> open_computed(const OpenStored& open, const OpenStored& open_first,
                                            const std::string& name, const ReadOptions& options) {
    if (const auto names = names_in_list(options.array.value_or(""));
        !names.empty() && !holds_array(open_first, options, *options.array))
        return open_vector(open, name, options, names);
    if (const auto derived = derived_from_name(options.component)) {
        std::vector<std::unique_ptr<VolumeSeries>> inputs;
        for (const auto& component : components_for(*derived)) {
            ReadOptions of_input = options;
            of_input.component = component;
            of_input.value_unit.reset(); // it is the result's
            inputs.push_back(open_stored_series(open, name, of_input));
            const SeriesInfo& first = inputs.front()->info();
            if (component && !first.array.ends_with(".0"))
                throw Error("{}: --component {} of {}, a scalar, expected a vector of three "
                            "components; --component gradient is for scalars",
                            name, *options.component, first.array);
        }
        return derived_series(std::move(inputs), *derived, "", options.value_unit);
    }
    if (options.resample && (options.crop || options.stride))
        throw Error("--resample with --crop or --stride: expected one of them");
    auto series = open(options);
    return options.resample ? resampled(std::move(series), *options.resample) : std::move(series);
}

} // namespace

std::unique_ptr<VolumeSeries> open_series(const std::vector<fs::path>& files,
                                          const ReadOptions& options, const Progress& progress) {
    const FilesSeen seen;
    readers_of_this_process().let_read(files);
    return open_computed(
        [&](const ReadOptions& one) { return open_as_it_is(files, one, progress); },
        [&](const ReadOptions& one) {
            return open_as_it_is(files.empty() ? files : std::vector{files.front()}, one, {});
        },
        files.empty() ? "" : files.front().string(), options);
}

std::unique_ptr<VolumeSeries> open_stored_series(const OpenStored& open, const std::string& name,
                                                 const ReadOptions& options) {
    return open_computed(open, open, name, options);
}

} // namespace isochron::index
