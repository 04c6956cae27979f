// GL reports that memory ran out by an error that is only seen when asked for.
#pragma once

#include "render/gl/gl.h"

#include <string_view>

namespace isochron::render {

/// The GL had no memory for something.
class OutOfMemory : public Error {
  public:
    using Error::Error;
};

/// Asks for GL's errors, which GL then forgets.
/// @param what the memory was for, as the message names it
/// @throws OutOfMemory if memory ran out since the last call
void expect_memory(const Gl& gl, std::string_view what);

} // namespace isochron::render
