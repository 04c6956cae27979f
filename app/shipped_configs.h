// The shipped configurations that are needed without their files.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace isochron::app {

/// Text of configs/<name>.toml as it was at build time; empty for a name that is not shipped.
std::optional<std::string> shipped_config(std::string_view name);

} // namespace isochron::app
