// The one series of files in a folder, beside logs, notes, thumbnails and parts of files.
#pragma once

#include "index/volume/volume_series.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace isochron::index {

struct FolderFiles {
    std::vector<std::filesystem::path> files;
    std::optional<std::string> note; ///< which files of values were left out
};

/// Finds the series that a folder holds. Files with the same name but for numbers belong together,
/// also in folders within, three deep. Hidden files, unknown ones, and files that others name (the
/// .raw of a .mhd, the pieces of a .pvti, all files beside one .pvd) do not count. A single file
/// beside one series is left out, which the note says.
/// @param options with `dims`, files whose sizes fit are raw values
/// @throws Error naming the folder: no file of values in it, or several series, which it lists
FolderFiles files_in_folder(const std::filesystem::path& folder, const ReadOptions& options);

} // namespace isochron::index
