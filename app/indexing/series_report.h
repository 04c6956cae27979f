// Describes a series as text and as JSON: the series of an index, or of files without an index.
#pragma once

#include "app/safe_text.h"
#include "index/volume/volume_series.h"

#include <nlohmann/json.hpp>

#include <string>

namespace isochron::app {

/// Between which steps, counted from 0, the step before is held where steps are blended, and why:
/// `between steps 2 and 3 (numbers are missing in the names): ...`. Empty: nowhere.
std::string gaps_text(const index::SeriesInfo& info);
/// A line each for array, grid, steps and type.
SafeText text_of(const index::SeriesInfo& info);
nlohmann::ordered_json json_of(const index::SeriesInfo& info);

/// What the files say about their series, and the value range of its first step, which is read.
/// @param name as the user gave it
SafeText source_text(const std::string& name, index::VolumeSeries& series);
nlohmann::ordered_json source_json(const std::string& name, index::VolumeSeries& series);

} // namespace isochron::app
