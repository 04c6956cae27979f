// Arrays of Python as a series: a file describes them, and Python gives their values.
#pragma once

#include "index/volume/volume_series.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace isochron::app {

/// The arrays of one grid.
struct PythonArrays {
    /// A file of a known format with the same arrays, coordinates and attributes, whose values are
    /// not read: axes, units and times are found as in any such file.
    std::filesystem::path description;
    /// Passes the values of a step on, piece by piece: [z][y][x], of the type that is named.
    std::function<void(const std::string& array, std::size_t step, index::ValueType type,
                       const index::TakePiece& take)>
        read;
    std::string name; ///< for messages, and as the source that an index names
};

/// @throws index::Error as opening the description does
std::unique_ptr<index::VolumeSeries> open_arrays(const PythonArrays& arrays,
                                                 const index::ReadOptions& options);

/// The series with other times. @throws index::Error: not one for each step, or not increasing
std::unique_ptr<index::VolumeSeries> with_times(std::unique_ptr<index::VolumeSeries> series,
                                                const std::vector<double>& times);

} // namespace isochron::app
