// Opens the files of a series, whatever their format.
#pragma once

#include "index/progress.h"
#include "index/volume/volume_series.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace isochron::index {

/// Opens files, a glob's result or a .pvd as one series. Files are put in the order of the times that
/// they, or a .pvd, state; without times in that of the numbers in their names (`t0.5` before `t2`
/// before `t10`).
/// @param progress reports `opening files`, where there are many; may be empty
/// @throws Error: unreadable, unknown format, several arrays and none chosen (lists them), ...
std::unique_ptr<VolumeSeries> open_series(const std::vector<std::filesystem::path>& files,
                                          const ReadOptions& options = {},
                                          const Progress& progress = {});

/// Opens one array as it is stored, whatever the options say of what is computed.
using OpenStored = std::function<std::unique_ptr<VolumeSeries>(const ReadOptions& options)>;
/// A series of what is no file, or the scalar that `component` computes of it.
/// @param open called for each array that is needed @param name for messages
/// @throws Error as `open` does, and as `open_series` does for files
std::unique_ptr<VolumeSeries> open_stored_series(const OpenStored& open, const std::string& name,
                                                 const ReadOptions& options);

} // namespace isochron::index
