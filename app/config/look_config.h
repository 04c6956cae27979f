// Reading of the tables about colors and the look of the picture.
#pragma once

#include "app/config/color_map_file.h"
#include "app/config/toml_reader.h"
#include "interaction/commands.h"

#include <string>
#include <vector>

namespace isochron::app {

/// Reads the table `coloring`, and the file of color maps that it names. The file's path may be
/// relative to the folder of the configuration.
/// @param name of the configuration's file
void read_coloring(TomlReader& reader, const std::string& name, interaction::Coloring& coloring,
                   std::vector<LoadedColorMap>& color_maps);
/// Reads the table `look`.
void read_look(TomlReader& reader, interaction::Look& look);

} // namespace isochron::app
