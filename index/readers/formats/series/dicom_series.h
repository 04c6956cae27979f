// DICOM files as one series.
#pragma once

#include "index/readers/formats/format.h"
#include "index/readers/formats/series/file_series.h"

#include <filesystem>
#include <vector>

namespace isochron::index {

/// The files of a series together: the reader puts them in their order. @see Format::join
std::vector<SeriesFile> dicom_series(const Format& format,
                                     const std::vector<std::filesystem::path>& files,
                                     const ReadOptions& options);

} // namespace isochron::index
