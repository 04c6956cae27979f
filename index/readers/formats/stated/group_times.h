// Times of steps that have a group each, in whatever container.
#pragma once

#include "index/readers/formats/stated/stated_array.h"
#include "index/volume/volume_series.h"

#include <functional>
#include <optional>
#include <span>
#include <string>

namespace isochron::index {

/// Whether an object states the time of a step, as a number or a date.
bool states_time(const StatedAttributes& object);

/// Sets the times of steps whose arrays lie in groups, or of the only step: the time that the nearest
/// group around an array states, in an array of one value or an attribute (openPMD's `timeUnitSI`
/// included), else what the names of the groups state.
/// @param paths of the arrays, in the order of the steps @param object_at attributes by path
/// @param time_in the time in an array of a group, with its value; none
void place_group_times(std::span<const std::string> paths,
                       const std::function<StatedAttributes(const std::string& path)>& object_at,
                       const std::function<std::optional<StatedAxis>(const std::string&)>& time_in,
                       const ReadOptions& options, SeriesInfo& info);

} // namespace isochron::index
