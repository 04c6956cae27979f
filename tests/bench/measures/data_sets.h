// The series that the benchmark generates.
#pragma once

#include "app/generate/demo_fields.h"
#include "index/file/index_file.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace isochron::bench {

struct DataSet {
    std::string name; ///< as in the rows: `sphere`, `vorticity64`, `fourier128`, `fourier256`
    std::variant<app::SphereSeries, app::VorticitySeries, app::FourierSeries> series;
    std::optional<double> isovalue; ///< to measure at; empty: the one with `active_cells`
    double active_cells = 0;        ///< wanted mean number of active cells
};

/// The choices of `--data`, in the order they are measured.
const std::vector<std::string>& data_names();

/// @param name one of `data_names()`
/// @param steps number of steps; empty: as the name has
DataSet data_set(const std::string& name, index::ValueType type, std::optional<std::size_t> steps);

/// The series in memory.
std::unique_ptr<index::VolumeSeries> made_series(const DataSet& data,
                                                 const index::Progress& progress);

/// Makes the series and builds its index as `isochron build` does.
std::shared_ptr<const index::IndexFile>
build_file(const DataSet& data, const std::filesystem::path& file, const index::Progress& progress);

} // namespace isochron::bench
