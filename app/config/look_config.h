// Reading of the tables about colors and the look of the picture.
#pragma once

#include "app/config/color_map_file.h"
#include "app/config/toml_reader.h"
#include "interaction/commands.h"

#include <string>
#include <vector>

namespace isochron::app {

/// Table `coloring`, with the color maps of the file that it names: beside the configuration, where
/// its path is relative.
/// @param name of the configuration's file
void read_coloring(TomlReader& reader, const std::string& name, interaction::Coloring& coloring,
                   std::vector<LoadedColorMap>& color_maps);
/// Table `look`.
void read_look(TomlReader& reader, interaction::Look& look);

} // namespace isochron::app
