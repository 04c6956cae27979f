// The program's name and version as it reports them.
#pragma once

#include "version_number.h"

#include <string_view>

namespace isochron::app {

constexpr std::string_view kVersion = ISOCHRON_VERSION;
constexpr std::string_view kProgram = "isochron " ISOCHRON_VERSION;

} // namespace isochron::app
