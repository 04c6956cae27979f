// A check of values on the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>

namespace isochron::app {

/// Accepts finite numbers above zero, and says so in one line otherwise.
inline CLI::Validator positive_number() {
    return {[](std::string& text) {
                double value = 0;
                const bool good =
                    CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value > 0;
                return good ? std::string()
                            : fmt::format("expected a positive number, got {}", text);
            },
            ""};
}

} // namespace isochron::app
