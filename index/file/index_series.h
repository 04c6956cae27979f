// An index as a series, so that another one can be built of it; also one of file version 2.
#pragma once

#include "index/file/index_contents.h"
#include "index/volume/volume_series.h"

#include <memory>
#include <optional>
#include <string>

namespace isochron::index {

/// Whether the file begins as an index does, of whatever version. @throws Error when unreadable
bool is_index(const std::filesystem::path& path);

/// The name of the array that an index carries to color by, if any.
/// @throws Error as `open_index_series`
std::optional<std::string> color_of_index(const std::filesystem::path& path);

/// The volume of an index, or the array that it carries to color by where `options.array` names
/// that one. What options say of grid, times and units counts before what the index says.
/// @throws Error: damaged, neither of version 2 nor of this one, refers to its sources, or has no
///         such array
std::unique_ptr<VolumeSeries> open_index_series(const std::filesystem::path& path,
                                                const ReadOptions& options);

} // namespace isochron::index
