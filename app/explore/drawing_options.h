// Options that all drawing commands share: how cells are drawn.
#pragma once

#include "app/command_line/command_line.h"
#include "app/config/config.h"

#include <optional>
#include <string>

namespace isochron::app {

/// Adds `--shape`. @param shape lives until the command has run
void add_shape_option(Command& command, std::optional<std::string>& shape);
/// Sets the configured shape if the option was given.
void set_shape(Config& config, const std::optional<std::string>& shape);

} // namespace isochron::app
