// Describes a configuration and finds its problems: `isochron explore --check-config`.
#pragma once

#include "app/config/config.h"
#include "app/config/config_problem.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace isochron::app {

std::vector<ConfigProblem> problems_of(const Config& config);
/// Those of the trackers and their devices.
std::vector<ConfigProblem> device_problems_of(const Config& config);

/// The problem as a line, with `warning:` if it may be intended:
/// `cave.toml:12: windows.viewports.projection: it is mirrored`.
std::string line_of(const ConfigProblem& problem, const Config& config);

/// The problems as a list of objects, each with line, key, text and whether it is an error.
nlohmann::ordered_json json_of(const std::vector<ConfigProblem>& problems, const Config& config);

/// @throws ConfigError with the first problem that is an error, in one line
void expect_sound(const Config& config);

/// A line for each viewer, window, viewport, screen and device.
std::string describe(const Config& config);

/// Prints the description, then every problem.
/// @throws ConfigError when a problem is an error
void check_config(const Config& config);

} // namespace isochron::app
