// The exception type of the interaction floor.
#pragma once

#include <fmt/core.h>

#include <stdexcept>
#include <utility>

namespace isochron::interaction {

/// Bad input of the interaction floor: `walk.jsonl:17: time goes back from 3.20 to 3.10`.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
    /// The message as a format with its values.
    template <class... Values>
    explicit Error(fmt::format_string<Values...> text, Values&&... values)
        : std::runtime_error(fmt::format(text, std::forward<Values>(values)...)) {}
};

} // namespace isochron::interaction
