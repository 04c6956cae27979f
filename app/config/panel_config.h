// The panel in the room and the operator's console, as configuration files describe them.
#pragma once

#include "app/config/toml_reader.h"
#include "stereo/installation.h"

#include <optional>

namespace isochron::app {

struct PanelConfig {
    bool room = false;      ///< the panel stands in the room from the start
    float width = 0.46f;    ///< [m] of the panel in the room
    float distance = 0.65f; ///< [m] from the eyes, at which it appears
    float font_scale = 1;   ///< size of the other panels, times the desktop's scale
    /// A window that shows only the panel; its viewports and stereo mode are ignored.
    std::optional<stereo::Window> console;
};

/// Reads the tables `panel` and `console` of a configuration file.
void read_panel(TomlReader& root, PanelConfig& panel);

} // namespace isochron::app
