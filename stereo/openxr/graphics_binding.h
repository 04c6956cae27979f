// How a GL context is handed over to an OpenXR runtime.
#pragma once

#include "stereo/context/native_gl.h"

#include <openxr/openxr.h>

#include <memory>

namespace isochron::stereo {

class OpenXrInstance;

/// The structure that a session is created with.
class OpenXrGraphics {
  public:
    /// Asks for the runtime's requirements too, as every runtime demands it.
    /// @throws OpenXrError when the context is none that the instance's binding can hand over, or
    /// the runtime wants another OpenGL
    OpenXrGraphics(const OpenXrInstance& instance, const NativeGl& context);
    ~OpenXrGraphics();
    const void* next() const; ///< for XrSessionCreateInfo

  private:
    struct Structure;
    std::unique_ptr<Structure> structure_;
};

} // namespace isochron::stereo
