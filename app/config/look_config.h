// Reading of the tables about colors and the look of the picture.
#pragma once

#include "app/config/config.h"
#include "app/config/toml_reader.h"

namespace isochron::app {

/// Table `coloring`, with the color maps of the file that it names: beside the configuration, where
/// its path is relative.
void read_coloring(TomlReader& reader, Config& config);
/// Table `look`.
void read_look(TomlReader& reader, interaction::Look& look);

} // namespace isochron::app
