// A series of files, each with one step or several.
#pragma once

#include "index/progress.h"
#include "index/readers/formats/volume_file.h"
#include "index/system/input_file.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::index {

struct SeriesFile {
    std::filesystem::path path;
    OpenVolumeFile open = {};
    std::optional<double> time; ///< given by an index of the series (.pvd), before what files say
};

/// The number by which an index knows the files of a step: it changes when one is written to.
std::uint64_t number_of(std::span<const FileState> states);

/// Opens every file once, and checks that all agree with the first in vertices, spacing, origin,
/// direction, array, type and scaling. Files whose header is equal to that of the first
/// (vti_header_hash.h) are not opened, nor are those that `options.steps` leaves out, if the first has
/// one step and files state no times. Times come from `files`, or else from the files' contents,
/// in the unit of the first, or else are step numbers; `options` override them.
/// @param notes on how the files were found
/// @param progress of many files
/// @throws Error naming both files when two disagree, or when times do not increase
std::unique_ptr<VolumeSeries> open_file_series(std::vector<SeriesFile> files,
                                               const ReadOptions& options,
                                               const std::vector<std::string>& notes = {},
                                               const Progress& progress = {});

} // namespace isochron::index
