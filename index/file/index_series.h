// Reads an index as a series, to build another index from it; also an index of file version 2.
#pragma once

#include "index/file/sections/index_contents.h"
#include "index/volume/volume_series.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isochron::index {

/// Whether the file begins like an index of any version. @throws Error when unreadable
bool is_index(const std::filesystem::path& path);

/// The name of an index's array to color by, if it has one.
/// @throws Error as `open_index_series`
std::optional<std::string> color_of_index(const std::filesystem::path& path);

/// The names of its arrays that have search structures; at least one.
/// @throws Error as `open_index_series`
std::vector<std::string> arrays_of_index(const std::filesystem::path& path);

/// The first array of an index, or the one that `options.array` names, also its array to color by.
/// Grid, times and units in `options` override the index's own.
/// @throws Error: damaged, neither version 2 nor this version, refers to its sources, no such array
std::unique_ptr<VolumeSeries> open_index_series(const std::filesystem::path& path,
                                                const ReadOptions& options);

} // namespace isochron::index
