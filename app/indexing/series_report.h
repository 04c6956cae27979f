// Describes a series as text and as JSON: the series of an index, or of files without an index.
#pragma once

#include "index/volume/volume_series.h"

#include <nlohmann/json.hpp>

#include <string>

namespace isochron::app {

/// A line each for array, grid, steps and type.
std::string text_of(const index::SeriesInfo& info);
nlohmann::ordered_json json_of(const index::SeriesInfo& info);

/// What the files say about their series, and the value range of its first step, which is read.
/// @param name as the user gave it
std::string source_text(const std::string& name, index::VolumeSeries& series);
std::string source_json(const std::string& name, index::VolumeSeries& series);

} // namespace isochron::app
