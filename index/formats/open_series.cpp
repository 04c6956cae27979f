// Finds the format of each file and opens them as a series.
#include "index/error.h"
#include "index/formats/data_stream.h"
#include "index/formats/derived_series.h"
#include "index/formats/dicom_files.h"
#include "index/formats/file_series.h"
#include "index/formats/joined_blocks.h"
#include "index/formats/json_series.h"
#include "index/formats/natural_order.h"
#include "index/formats/readers.h"
#include "index/formats/resampled_series.h"
#include "index/formats/slice_files.h"
#include "index/formats/text_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

struct Format {
    std::string_view extension;
    std::unique_ptr<VolumeFile> (*open)(const fs::path&, const ReadOptions&);
};

/// One entry for each extension; the first that matches the end of a name is used.
constexpr std::array kFormats{
    Format{".vti", open_vti},       Format{".vtk", open_vtk},       Format{".mhd", open_metaimage},
    Format{".mha", open_metaimage}, Format{".nrrd", open_nrrd},     Format{".nhdr", open_nrrd},
    Format{".nii", open_nifti},     Format{".nii.gz", open_nifti},  Format{".hdr", open_nifti},
    Format{".hdr.gz", open_nifti},  Format{".img", open_nifti},     Format{".img.gz", open_nifti},
    Format{".nc", open_netcdf},     Format{".nc4", open_netcdf},    Format{".cdf", open_netcdf},
    Format{".vtr", open_vtk_data},  Format{".pvti", open_vtk_data}, Format{".pvtr", open_vtk_data},
    Format{".vtu", open_vtk_data},  Format{".vts", open_vtk_data},  Format{".pvtu", open_vtk_data},
    Format{".pvts", open_vtk_data}, Format{".vtm", open_vtk_data},  Format{".vth", open_vtk_data},
    Format{".tif", open_tiff},      Format{".tiff", open_tiff},     Format{".btf", open_tiff},
    Format{".h5", open_hdf5},       Format{".hdf5", open_hdf5},     Format{".he5", open_hdf5},
    Format{"zarr.json", open_zarr}, Format{".zattrs", open_zarr},   Format{".zarray", open_zarr},
    Format{".zgroup", open_zarr},   Format{".zip", open_zarr},      Format{".ozx", open_zarr},
    Format{".hdf", open_hdf5},      Format{".vtkhdf", open_hdf5},   Format{".raw", open_raw},
    Format{".dcm", open_dicom},     Format{".dicom", open_dicom},   Format{".ima", open_dicom},
    Format{".bov", open_bov},       Format{".xmf", open_xdmf},      Format{".xdmf", open_xdmf},
};

/// Of a Zarr folder the file that describes it; else the path itself.
fs::path described_in(const fs::path& path) {
    std::error_code ignored;
    for (const char* name : {"zarr.json", ".zattrs", ".zarray", ".zgroup"})
        if (fs::is_directory(path, ignored) && fs::is_regular_file(path / name, ignored))
            return path / name;
    return path;
}

SeriesFile series_file(const fs::path& given, const ReadOptions& options,
                       std::optional<double> time = {}) {
    const fs::path path = described_in(given);
    file_bytes(path);
    const std::string name = lower_case(path.filename().string());
    for (const Format& format : kFormats)
        if (name.ends_with(format.extension))
            return {path, format.open, time};
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

bool names_its_files(const fs::path& path) {
    return is_pvd(path) || lower_case(path.extension().string()) == ".series";
}

std::unique_ptr<VolumeSeries> open_as_it_is(const std::vector<fs::path>& given,
                                            const ReadOptions& options) {
    const std::vector<fs::path> files = with_dicom_folders(given);
    if (files.empty())
        throw Error("no files given");
    std::vector<SeriesFile> series;
    const auto list = std::find_if(files.begin(), files.end(), names_its_files);
    if (list != files.end()) {
        const std::string name = list->string();
        if (files.size() != 1)
            throw Error(
                fmt::format("{}: names its files itself, {} more given", name, files.size() - 1));
        if (options.times_from_names)
            throw Error(fmt::format("{}: gives the times itself, --times-from-names cannot", name));
        file_bytes(*list);
        for (const auto& [path, time] : is_pvd(*list) ? read_pvd(*list) : read_json_series(*list))
            series.push_back(series_file(path, options, time));
        return open_file_series(
            is_pvd(*list) ? joined_by_time(std::move(series)) : std::move(series), options);
    }
    if (options.times_from_names)
        return open_file_series(timed_by_name(files, options), options);
    if (!options.dims && std::ranges::all_of(files, is_dicom))
        return open_file_series({dicom_series(files)}, options);
    if (std::ranges::all_of(files, is_tiff))
        return open_file_series(tiff_series(files, options), options);
    for (const fs::path& path : files)
        series.push_back(series_file(path, options));
    std::stable_sort(series.begin(), series.end(), [](const SeriesFile& a, const SeriesFile& b) {
        return natural_less(a.path.string(), b.path.string());
    });
    return open_file_series(std::move(series), options);
}

} // namespace

std::string known_extensions() {
    std::string known = ".pvd .series";
    for (const Format& format : kFormats)
        known += fmt::format(" {}", format.extension);
    return known;
}

std::unique_ptr<VolumeSeries> open_series(const std::vector<fs::path>& files,
                                          const ReadOptions& options) {
    if (const auto derived = derived_from_name(options.component)) {
        std::vector<std::unique_ptr<VolumeSeries>> inputs;
        for (const auto& component : components_for(*derived)) {
            ReadOptions of_input = options;
            of_input.component = component;
            of_input.value_unit.reset(); // it is the result's
            inputs.push_back(open_series(files, of_input));
        }
        return derived_series(std::move(inputs), *derived, options.value_unit);
    }
    auto series = open_as_it_is(files, options);
    return options.resample ? resampled(std::move(series), *options.resample) : std::move(series);
}

} // namespace isochron::index
