// What is wrong with a configuration.
#pragma once

#include <fmt/core.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace isochron::app {

/// `configs/desktop.toml:12: unknown key 'eye_seperation' in [viewer]; did you mean
/// 'eye_separation'?`
class ConfigError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
    /// The message as a format with its values.
    template <class... Values>
    explicit ConfigError(fmt::format_string<Values...> text, Values&&... values)
        : std::runtime_error(fmt::format(text, std::forward<Values>(values)...)) {}
};

/// Part of a configuration that can be read but will not work, or that only looks odd.
struct ConfigProblem {
    int line = 0;    ///< line of the file; 0: it is not in the file
    std::string key; ///< `windows.viewports.projection`
    std::string text;
    bool wrong = true; ///< an error; false: a warning, as it may be intended
};

} // namespace isochron::app
