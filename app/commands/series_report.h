// What a series is, as text and as JSON: of an index, and of files that none was made of.
#pragma once

#include "index/volume/volume_series.h"

#include <nlohmann/json.hpp>

#include <string>

namespace isochron::app {

/// A line each for array, grid, steps and type.
std::string text_of(const index::SeriesInfo& info);
nlohmann::ordered_json json_of(const index::SeriesInfo& info);

/// All that files of values say, and the range of their first step, which is read for it.
/// @param name as the user gave it
std::string source_text(const std::string& name, index::VolumeSeries& series);
std::string source_json(const std::string& name, index::VolumeSeries& series);

} // namespace isochron::app
