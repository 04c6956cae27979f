// The error message of a configuration, for tests.
#pragma once

#include "app/config/config.h"

#include <string>

namespace isochron::app {

/// The error of a file `lab.toml` with this text.
inline std::string error_of(const std::string& text) {
    try {
        parse_config(text, "lab.toml");
    } catch (const ConfigError& error) {
        return error.what();
    }
    return "no error";
}

} // namespace isochron::app
