// What a configuration describes and what is wrong with it: `isochron explore --check-config`.
#pragma once

#include "app/config/config.h"

#include <filesystem>
#include <string>
#include <vector>

namespace isochron::app {

/// Something in a configuration that reads well and yet will not work, or only looks odd.
struct ConfigProblem {
    int line = 0;    ///< of the file; 0: it stands nowhere
    std::string key; ///< `windows.viewports.projection`
    std::string text;
    bool wrong = true; ///< false: worth a look, but it may be meant
};

std::vector<ConfigProblem> problems_of(const Config& config);

/// `cave.toml:12: windows.viewports.projection: it is mirrored`; `warning:` before what may be
/// meant.
std::string line_of(const ConfigProblem& problem, const Config& config);

/// Every viewer, window, viewport, screen and device, a line each.
std::string describe(const Config& config);

/// Prints the description, then every problem on stderr.
/// @throws ConfigError when the file cannot be read or something is wrong
void check_config(const std::filesystem::path& path);

} // namespace isochron::app
