// What can be wrong with a configuration.
#pragma once

#include <string>

namespace isochron::app {

/// Something in a configuration that reads well and yet will not work, or only looks odd.
struct ConfigProblem {
    int line = 0;    ///< of the file; 0: it stands nowhere
    std::string key; ///< `windows.viewports.projection`
    std::string text;
    bool wrong = true; ///< false: worth a look, but it may be meant
};

} // namespace isochron::app
