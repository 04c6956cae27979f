// The shipped configurations, compiled into the program.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::app {

/// Text of configs/<name>.toml as it was at build time; empty for a name that is not shipped.
std::optional<std::string> shipped_config(std::string_view name);

/// Their names, as in `--config cave4`.
std::vector<std::string> shipped_config_names();

} // namespace isochron::app
