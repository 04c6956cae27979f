// Gets the handles of a window's context from GLFW, GLX and EGL.
#include "stereo/context/gl_context_glfw_native.h"

#include "stereo/context/glx_types.h"
#include "stereo/context/shared_library.h"

#include "index/error.h"
#include "index/system/module.h"

#define EGL_NO_X11
#include <EGL/egl.h>

// Types of Xrandr, for which GLFW's header would include all of it.
using RRCrtc = XID;
using RROutput = XID;
#define GLFW_INCLUDE_NONE
#define GLFW_NATIVE_INCLUDE_NONE
#define GLFW_EXPOSE_NATIVE_X11
#define GLFW_EXPOSE_NATIVE_GLX
#define GLFW_EXPOSE_NATIVE_EGL
#include <GLFW/glfw3.h>
#include <GLFW/glfw3native.h>

namespace isochron::stereo {

void* glfw_function(const char* name) {
    try {
        return index::module_symbol("isochron_glfw", name);
    } catch (const index::Error&) {
        return nullptr;
    }
}

namespace {

/// Looks up the configuration of a context, for both libraries: a context tells only its number.
template <typename Query, typename Choose>
auto config_of(Query query, Choose choose, int id_name, int end) {
    int id = 0;
    query(id_name, &id);
    const int attributes[] = {id_name, id, end};
    return choose(attributes);
}

EglHandles egl_handles(GLFWwindow* window) {
    const SharedLibrary library("libEGL.so.1");
    decltype(&eglQueryContext) query;
    decltype(&eglChooseConfig) choose;
    decltype(&eglGetProcAddress) get;
    library.get(query, "eglQueryContext");
    library.get(choose, "eglChooseConfig");
    library.get(get, "eglGetProcAddress");
    EGLDisplay display = glfwGetEGLDisplay();
    EGLContext context = glfwGetEGLContext(window);
    EGLConfig config =
        config_of([&](int name, int* value) { query(display, context, name, value); },
                  [&](const int* attributes) {
                      EGLConfig found = nullptr;
                      EGLint count = 0;
                      choose(display, attributes, &found, 1, &count);
                      return found;
                  },
                  EGL_CONFIG_ID, EGL_NONE);
    return {display, config, context, get};
}

/// Functions that a GLFW for Wayland alone lacks, as that of Debian 12's libglfw3-wayland: null there.
struct GlfwOfX11 {
    decltype(&glfwGetX11Display) display;
    decltype(&glfwGetGLXContext) context;
    decltype(&glfwGetGLXWindow) window;
};

GlfwOfX11 glfw_of_x11() {
    const auto find = []<class F>(F*& function, const char* name) {
        function = reinterpret_cast<F*>(glfw_function(name));
    };
    GlfwOfX11 found{};
    find(found.display, "glfwGetX11Display");
    find(found.context, "glfwGetGLXContext");
    find(found.window, "glfwGetGLXWindow");
    return found;
}

GlxHandles glx_handles(GLFWwindow* window, const GlfwOfX11& x11) {
    constexpr int kConfigId = 0x8013, kVisualId = 0x800B, kEnd = 0; // GLX 1.3
    const SharedLibrary library("libGL.so.1"), xlib("libX11.so.6");
    int (*query)(Display*, GLXContext, int, int*);
    GLXFBConfig* (*choose)(Display*, int, const int*, int*);
    int (*attribute)(Display*, GLXFBConfig, int, int*);
    int (*release)(void*);
    library.get(query, "glXQueryContext");
    library.get(choose, "glXChooseFBConfig");
    library.get(attribute, "glXGetFBConfigAttrib");
    xlib.get(release, "XFree");
    Display* display = x11.display();
    GLXContext context = x11.context(window);
    GLXFBConfig config =
        config_of([&](int name, int* value) { query(display, context, name, value); },
                  [&](const int* attributes) -> GLXFBConfig {
                      int count = 0;
                      GLXFBConfig* found =
                          choose(display, DefaultScreen(display), attributes, &count);
                      const GLXFBConfig first = count > 0 ? found[0] : nullptr;
                      if (found)
                          release(found);
                      return first;
                  },
                  kConfigId, kEnd);
    int visual = 0;
    if (config)
        attribute(display, config, kVisualId, &visual);
    return {display, static_cast<std::uint32_t>(visual), config, x11.window(window), context};
}

} // namespace

NativeGl native_of(GLFWwindow* window) {
    if (glfwGetWindowAttrib(window, GLFW_CONTEXT_CREATION_API) == GLFW_EGL_CONTEXT_API)
        return egl_handles(window);
    const GlfwOfX11 x11 = glfw_of_x11();
    if (x11.display && x11.context && x11.window && x11.display() && x11.context(window))
        return glx_handles(window, x11);
    return {};
}

} // namespace isochron::stereo
