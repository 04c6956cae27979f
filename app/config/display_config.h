// The part of a configuration that describes displays: viewers, windows, viewports and screens.
#pragma once

#include "app/config/toml_reader.h"
#include "stereo/installation.h"

#include <vector>

namespace isochron::app {

/// Lines of the file, in the order of what they describe; 0 for what stands in no file.
struct DisplayPlaces {
    struct Window {
        int line = 0;
        std::vector<int> viewports; ///< of their screens, where these have a table of their own
    };
    std::vector<int> viewers;
    std::vector<Window> windows;
};

/// Reads `viewer` or `viewers`, and `windows`; what is absent keeps its default.
/// @throws ConfigError
DisplayPlaces read_displays(TomlReader& reader, stereo::Installation& installation);

} // namespace isochron::app
