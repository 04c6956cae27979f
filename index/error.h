// The one exception type of the index floor.
#pragma once

#include <fmt/core.h>

#include <stdexcept>
#include <utility>

namespace isochron::index {

/// Bad input or a failed file operation. The message says what, where, expected and got, in one
/// line: `heart_07.vti: 256x256x90 vertices, heart_00.vti has 512x512x90`.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
    /// The message as a format with its values.
    template <class... Values>
    explicit Error(fmt::format_string<Values...> text, Values&&... values)
        : std::runtime_error(fmt::format(text, std::forward<Values>(values)...)) {}
};

} // namespace isochron::index
