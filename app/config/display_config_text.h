// Writes an installation as the TOML that configurations are written in.
#pragma once

#include "stereo/installation.h"

#include <string>

namespace isochron::app {

/// A configuration that describes only the installation; reading it gives the same installation.
std::string display_config_text(const stereo::Installation& installation);

} // namespace isochron::app
