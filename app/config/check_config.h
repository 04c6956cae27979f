// What a configuration describes and what is wrong with it: `isochron explore --check-config`.
#pragma once

#include "app/config/config.h"
#include "app/config/config_problem.h"

#include <filesystem>
#include <string>
#include <vector>

namespace isochron::app {

std::vector<ConfigProblem> problems_of(const Config& config);

/// `cave.toml:12: windows.viewports.projection: it is mirrored`; `warning:` before what may be
/// meant.
std::string line_of(const ConfigProblem& problem, const Config& config);

/// @throws ConfigError with the first problem that is wrong, in one line
void expect_sound(const Config& config);

/// Every viewer, window, viewport, screen and device, a line each.
std::string describe(const Config& config);

/// Prints the description, then every problem.
/// @throws ConfigError when the file cannot be read or something is wrong
void check_config(const std::filesystem::path& path);

} // namespace isochron::app
