// The one exception type of the index floor.
#pragma once

#include <stdexcept>

namespace isochron::index {

/// Bad input or a failed file operation. The message says what, where, expected and got, in one
/// line: `heart_07.vti: 256x256x90 vertices, heart_00.vti has 512x512x90`.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

} // namespace isochron::index
