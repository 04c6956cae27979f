// Opening of a series that says how far it is: of many files it takes seconds.
#pragma once

#include "index/progress.h"
#include "index/volume/volume_series.h"

namespace isochron::index {

/// `open_series` with progress.
/// @param progress of `opening files`, where there are many; may be empty
std::unique_ptr<VolumeSeries> open_series(const std::vector<std::filesystem::path>& files,
                                          const ReadOptions& options, const Progress& progress);

} // namespace isochron::index
