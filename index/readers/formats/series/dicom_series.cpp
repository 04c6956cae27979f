// Opens DICOM files together.
#include "index/readers/formats/series/dicom_series.h"

#include "index/readers/formats/foreign_file.h"

namespace isochron::index {

namespace fs = std::filesystem;

std::vector<SeriesFile> dicom_series(const Format& format, const std::vector<fs::path>& files,
                                     const ReadOptions& /*options*/) {
    SeriesFile series{.path = files.front(), .open = opener_of(format), .time = {}};
    if (files.size() > 1)
        series.open = [&format, files](const fs::path& path, const ReadOptions& options) {
            ReadOptions with = options;
            with.slices = files;
            return open_in_format(format, path, with);
        };
    return {series};
}

} // namespace isochron::index
