// The exception type of the interaction floor.
#pragma once

#include <stdexcept>

namespace isochron::interaction {

/// Bad input of the interaction floor: `walk.jsonl:17: time goes back from 3.20 to 3.10`.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

} // namespace isochron::interaction
