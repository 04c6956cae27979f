// ParaView's lists of files in JSON: `run.vti.series`.
#pragma once

#include "index/readers/formats/format.h"

namespace isochron::index {

/// The files and times of such a list, in the order of their times, paths made relative to where
/// the program runs. @throws Error naming the file
ListedFiles read_json_series(const std::filesystem::path& path);

} // namespace isochron::index
