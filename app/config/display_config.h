// The part of a configuration that describes displays: viewers, windows, viewports and screens.
#pragma once

#include "app/config/toml_reader.h"
#include "stereo/installation.h"

#include <vector>

namespace isochron::app {

/// Lines of the file that describe viewers, windows and viewports; 0 if none does.
struct DisplayPlaces {
    struct Window {
        int line = 0;
        std::vector<int> viewports; ///< line of a viewport's screen, if that has its own table
    };
    std::vector<int> viewers;
    std::vector<Window> windows;
};

/// Reads `viewer` or `viewers`, and `windows`; what is absent keeps its default.
/// @throws ConfigError
DisplayPlaces read_displays(TomlReader& reader, stereo::Installation& installation);

} // namespace isochron::app
