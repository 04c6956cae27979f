// A problem that a check found in a configuration.
#pragma once

#include <string>

namespace isochron::app {

/// Part of a configuration that can be read but will not work, or that only looks odd.
struct ConfigProblem {
    int line = 0;    ///< line of the file; 0: it is not in the file
    std::string key; ///< `windows.viewports.projection`
    std::string text;
    bool wrong = true; ///< an error; false: a warning, as it may be intended
};

} // namespace isochron::app
