// The files that names stand for: of a folder the one series in it, beside logs, notes, thumbnails
// and parts of files.
#pragma once

#include "index/readers/formats/format.h"

#include <optional>
#include <string>
#include <vector>

namespace isochron::index {

struct FoundFiles {
    std::vector<KnownFile> files;
    std::optional<std::string> note; ///< says which files of values were left out
};

/// Replaces each folder, unless it is one volume, by the files in it: by all DICOM files, or else
/// by the series that it holds. Files whose names differ only in numbers belong together, also in
/// folders within, three deep. Hidden files, unknown ones, and files that others name (the
/// .raw of a .mhd, the pieces of a .pvti, all files beside one .pvd) do not count. A single file
/// beside one series is left out, which the note says.
/// @param options with `dims`, files whose sizes fit are raw values
/// @throws Error naming a folder: no file of values in it, or several series, which it lists
FoundFiles found_files(const std::vector<std::filesystem::path>& given, const ReadOptions& options);

} // namespace isochron::index
