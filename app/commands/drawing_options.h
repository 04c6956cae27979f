// Options on how cells are drawn, of all commands that draw.
#pragma once

#include "app/commands/command_line.h"
#include "app/config/config.h"

#include <optional>
#include <string>

namespace isochron::app {

/// Adds `--shape`. @param shape lives until the command has run
void add_shape_option(Command& command, std::optional<std::string>& shape);
/// Obeys it, where it was given.
void set_shape(Config& config, const std::optional<std::string>& shape);

} // namespace isochron::app
