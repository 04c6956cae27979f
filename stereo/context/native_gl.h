// The window system's handles of a GL context, for libraries that share its textures.
#pragma once

#include <cstdint>
#include <variant>

namespace isochron::stereo {

/// Handles of libEGL and GLX, without their headers.
struct EglHandles {
    void* display = nullptr; ///< EGLDisplay
    void* config = nullptr;  ///< EGLConfig; null: the context was made without one
    void* context = nullptr; ///< EGLContext
    void (*(*get_proc_address)(const char*))() = nullptr;
};
struct GlxHandles {
    void* display = nullptr; ///< Display of Xlib
    std::uint32_t visual_id = 0;
    void* fb_config = nullptr; ///< GLXFBConfig
    unsigned long drawable = 0;
    void* context = nullptr; ///< GLXContext
};
/// Empty if the context belongs to no window system (OSMesa).
using NativeGl = std::variant<std::monostate, EglHandles, GlxHandles>;

/// Which library makes a window's context.
enum class ContextApi : std::uint8_t { native, egl };

} // namespace isochron::stereo
