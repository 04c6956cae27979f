// Opens the trackers of a configuration, and describes them in words.
#pragma once

#include "app/config/config.h"
#include "interaction/input/composite_input.h"

#include <string>
#include <vector>

namespace isochron::app {

/// Adds every configured tracker to `input`.
/// @throws interaction::Error naming file, line and tracker: when an address cannot be bound, or
/// the program was built without this kind of tracker
void open_trackers(const Config& config, interaction::CompositeInput& input);

/// A line for each tracker and several indented lines for each of its devices: source, calibration,
/// and when it counts as lost. Opens nothing.
std::vector<std::string> describe_devices(const Config& config);

/// The trackers that the configuration asks for and this program was built without.
std::vector<ConfigProblem> missing_trackers(const Config& config);

} // namespace isochron::app
