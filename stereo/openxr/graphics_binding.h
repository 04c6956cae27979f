// Passes a GL context to an OpenXR runtime.
#pragma once

#include "stereo/context/native_gl.h"

#include <memory>

namespace isochron::stereo {

class OpenXrInstance;

/// The structure with the context, for creating a session.
class OpenXrGraphics {
  public:
    /// Also asks for the runtime's requirements, as OpenXR demands.
    /// @throws OpenXrError when the instance's binding does not fit the context, or the runtime
    /// needs another version of OpenGL
    OpenXrGraphics(const OpenXrInstance& instance, const NativeGl& context);
    ~OpenXrGraphics();
    const void* next() const; ///< for XrSessionCreateInfo

  private:
    struct Structure;
    std::unique_ptr<Structure> structure_;
};

} // namespace isochron::stereo
