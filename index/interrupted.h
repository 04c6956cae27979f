// Ends work that is no longer wanted.
#pragma once

#include <stdexcept>

namespace isochron::index {

/// Thrown through work that is no longer wanted, as after Ctrl-C. It says nothing about a file: code
/// that turns failures into errors of a file passes it on.
class Interrupted : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

} // namespace isochron::index
