// Opens files as a series: lists of files, slices, parts, or a file for each step.
#include "index/error.h"
#include "index/formats/data_stream.h"
#include "index/formats/known_formats.h"
#include "index/formats/readers.h"
#include "index/formats/series/derived_series.h"
#include "index/formats/series/dicom_files.h"
#include "index/formats/series/file_series.h"
#include "index/formats/series/folder_files.h"
#include "index/formats/series/joined_blocks.h"
#include "index/formats/series/json_series.h"
#include "index/formats/series/natural_order.h"
#include "index/formats/series/resampled_series.h"
#include "index/formats/series/slice_files.h"
#include "index/formats/series/vector_arrays.h"
#include "index/formats/text_header.h"
#include "index/lower_case.h"

#include <fmt/format.h>

#include <algorithm>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

SeriesFile series_file(const fs::path& given, const ReadOptions& options,
                       std::optional<double> time = {}) {
    const fs::path path = described_in(given);
    file_bytes(path);
    if (const OpenFormat format = format_of(path))
        return {path, format, time};
    if (is_dicom(path))
        return {path, open_dicom, time};
    // Raw data may have any name; giving dimensions says that a file is raw.
    if (options.dims)
        return {path, open_raw, time};
    throw Error(fmt::format("{}: unknown format, expected one of {}, or raw values with --dims and "
                            "--type",
                            path.string(), known_extensions()));
}

/// Orders files by the last number in their names, which is their time.
std::vector<SeriesFile> timed_by_name(const std::vector<fs::path>& files,
                                      const ReadOptions& options) {
    if (options.time_step)
        throw Error("--times-from-names and --time-step: expected one of the two");
    std::vector<SeriesFile> series;
    for (const fs::path& path : files) {
        const auto time = last_number_in(path.stem().string());
        if (!time)
            throw Error(fmt::format("{}: no number in its name, expected one for "
                                    "--times-from-names, as in t_0030.vti",
                                    path.string()));
        series.push_back(series_file(path, options, time));
    }
    std::ranges::stable_sort(series, {}, &SeriesFile::time);
    return series;
}

/// The files of a series together: the reader puts them in their order.
SeriesFile dicom_series(std::vector<fs::path> files) {
    SeriesFile series{.path = files.front(), .open = open_dicom, .time = {}};
    if (files.size() > 1)
        series.open = [files = std::move(files)](const fs::path& path, const ReadOptions& options) {
            ReadOptions with = options;
            with.slices = files;
            return open_dicom(path, with);
        };
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

bool is_pvd(const fs::path& path) {
    return lower_case(path.extension().string()) == ".pvd";
}

/// Of each folder the files in it, but for those that are read as they are.
FolderFiles out_of_folders(const std::vector<fs::path>& given, const ReadOptions& options) {
    FolderFiles all;
    std::error_code ignored;
    for (const fs::path& path : with_dicom_folders(given)) {
        if (!fs::is_directory(path, ignored) || described_in(path) != path) {
            all.files.push_back(path);
            continue;
        }
        FolderFiles found = files_in_folder(path, options);
        all.files.insert(all.files.end(), found.files.begin(), found.files.end());
        if (found.note)
            all.note = all.note ? *all.note + "; " + *found.note : found.note;
    }
    return all;
}

/// What a .pvd or .series names.
std::vector<SeriesFile> listed_in(const fs::path& list, const ReadOptions& options) {
    if (options.times_from_names)
        throw Error(
            fmt::format("{}: gives the times itself, --times-from-names cannot", list.string()));
    file_bytes(list);
    std::vector<SeriesFile> series;
    for (const auto& [path, time] : is_pvd(list) ? read_pvd(list) : read_json_series(list))
        series.push_back(series_file(path, options, time));
    return is_pvd(list) ? joined_by_time(std::move(series)) : series;
}

/// The steps of a series and the files of each.
std::vector<SeriesFile> series_of(const std::vector<fs::path>& files, const ReadOptions& options) {
    if (files.empty())
        throw Error("no files given");
    const auto list = std::find_if(files.begin(), files.end(), lists_files);
    if (list != files.end() && files.size() != 1)
        throw Error(fmt::format("{}: names its files itself, {} more given", list->string(),
                                files.size() - 1));
    if (list != files.end())
        return listed_in(*list, options);
    if (options.times_from_names)
        return timed_by_name(files, options);
    if (!options.dims && std::ranges::all_of(files, is_dicom))
        return {dicom_series(files)};
    if (std::ranges::all_of(files, is_tiff))
        return tiff_series(files, options);
    std::vector<SeriesFile> series;
    for (const fs::path& path : files)
        series.push_back(series_file(path, options));
    std::stable_sort(series.begin(), series.end(), [](const SeriesFile& a, const SeriesFile& b) {
        return natural_less(a.path.string(), b.path.string());
    });
    return series;
}

std::unique_ptr<VolumeSeries> open_as_it_is(const std::vector<fs::path>& given,
                                            const ReadOptions& options) {
    const FolderFiles found = out_of_folders(given, options);
    return open_file_series(series_of(found.files, options), options, found.note);
}

/// Whether files have an array of exactly this name.
bool holds_array(const fs::path& file, ReadOptions options, const std::string& name) {
    options.array.reset();
    options.component.reset();
    options.any_array = true;
    try {
        return std::ranges::any_of(
            open_series({file}, options)->info().arrays,
            [&](const std::string& offered) { return offered.starts_with(name + " ("); });
    } catch (const Error&) {
        return false;
    }
}

/// What is computed of a vector whose components are the arrays of a list.
std::unique_ptr<VolumeSeries> open_vector(const std::vector<fs::path>& files,
                                          const ReadOptions& options,
                                          const std::vector<std::string>& names) {
    const std::string component = options.component.value_or("magnitude");
    const auto derived = derived_from_name(component);
    if (derived ? *derived == Derived::gradient || names.size() != 3 : component != "magnitude")
        throw Error(fmt::format("--component {} of {}, expected magnitude{}", component,
                                *options.array,
                                names.size() == 3 ? ", vorticity or q-criterion" : ""));
    auto inputs = open_components(names, [&](const std::string& name) {
        ReadOptions of_input = options;
        of_input.array = name;
        of_input.component.reset();
        of_input.value_unit.reset(); // it is the result's
        return open_series(files, of_input);
    });
    return derived_series(std::move(inputs), derived.value_or(Derived::magnitude), *options.array,
                          options.value_unit);
}

} // namespace

std::unique_ptr<VolumeSeries> open_series(const std::vector<fs::path>& files,
                                          const ReadOptions& options) {
    if (const auto names = names_in_list(options.array.value_or(""));
        !names.empty() && !files.empty() && !holds_array(files.front(), options, *options.array))
        return open_vector(files, options, names);
    if (const auto derived = derived_from_name(options.component)) {
        std::vector<std::unique_ptr<VolumeSeries>> inputs;
        for (const auto& component : components_for(*derived)) {
            ReadOptions of_input = options;
            of_input.component = component;
            of_input.value_unit.reset(); // it is the result's
            inputs.push_back(open_series(files, of_input));
        }
        return derived_series(std::move(inputs), *derived, "", options.value_unit);
    }
    auto series = open_as_it_is(files, options);
    return options.resample ? resampled(std::move(series), *options.resample) : std::move(series);
}

} // namespace isochron::index
