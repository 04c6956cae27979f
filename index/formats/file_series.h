// A series made of files that each hold one step or several.
#pragma once

#include "index/formats/volume_file.h"

#include <optional>
#include <vector>

namespace isochron::index {

struct SeriesFile {
    std::filesystem::path path;
    OpenVolumeFile open = {};
    std::optional<double> time; ///< given by an index of the series (.pvd), before what files say
};

/// Opens every file once and holds them all to the first: vertices, spacing, origin, direction,
/// array, type and scaling. Times are those of `files`, of the files' contents, in the unit
/// of the first, or, when neither has any, step numbers; `options` override.
/// @throws Error naming both files when two disagree, or when times do not increase
std::unique_ptr<VolumeSeries> open_file_series(std::vector<SeriesFile> files,
                                               const ReadOptions& options);

} // namespace isochron::index
