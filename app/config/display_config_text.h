// Writing of an installation as the TOML that `read_displays` reads.
#pragma once

#include "stereo/installation.h"

#include <string>

namespace isochron::app {

/// A configuration that describes the installation and nothing else; read again it is the same one.
std::string display_config_text(const stereo::Installation& installation);

} // namespace isochron::app
