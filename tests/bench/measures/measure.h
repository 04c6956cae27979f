// Measures all structures on one series.
#pragma once

#include "index/file/index_file.h"
#include "tests/bench/measures/structures.h"
#include "tests/bench/rows/rows.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isochron::bench {

struct MeasureOptions {
    std::string data; ///< name of the series in the rows
    double isovalue = 0;
    unsigned rounds = 5;      ///< number of measurements of each time, for the median
    int error_isovalues = 64; ///< number of isovalues (quantiles) at which errors are counted
    StructureOptions structures;
};

/// Builds one structure after the other, and measures each in turn with the comparisons.
/// @return rows and details
Results measure(const std::shared_ptr<const index::IndexFile>& file, const MeasureOptions& options,
                const index::Progress& progress);

} // namespace isochron::bench
