// The error that a file is not there.
#pragma once

#include "index/error.h"

namespace isochron::index {

/// A file is not there.
class MissingFile : public Error {
  public:
    using Error::Error;
};

} // namespace isochron::index
