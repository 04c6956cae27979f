// Opens the trackers of a configuration, and says in words what they are.
#pragma once

#include "app/config/config.h"
#include "interaction/composite_input.h"

#include <string>
#include <vector>

namespace isochron::app {

/// Adds every configured tracker to `input`.
/// @throws interaction::Error naming file, line and tracker: an address that cannot be bound, or a kind that
/// this program was built without
void open_trackers(const Config& config, interaction::CompositeInput& input);

/// A line for each tracker and, indented, several for each of its devices: where it comes from, how
/// it is calibrated, when it counts as lost. Opens nothing.
std::vector<std::string> describe_devices(const Config& config);

/// A tracker that the configuration asks for and this program was built without.
struct MissingTracker {
    int line;
    std::string key, text;
};
std::vector<MissingTracker> missing_trackers(const Config& config);

/// What is odd about the devices, one line each; empty when nothing is.
std::vector<std::string> device_warnings(const Config& config);

} // namespace isochron::app
