// GLFW's functions as this program calls them. GLFW and the six libraries of X11 that it brings are loaded by
// the first call: most commands open no window.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#define GLFW_EXPOSE_NATIVE_EGL
#include <GLFW/glfw3native.h>

#include "index/system/module.h"

// Each function is found in GLFW, which the module links, and called from then on.
#define ISOCHRON_FORWARD(name, parameters, arguments)                                              \
    auto name parameters->decltype(name arguments) {                                               \
        static auto* const found = reinterpret_cast<decltype(&name)>(                              \
            isochron::index::module_symbol("isochron_glfw", #name));                               \
        return found arguments;                                                                    \
    }

extern "C" {
ISOCHRON_FORWARD(glfwCreateWindow,
                 (int width, int height, const char* title, GLFWmonitor* monitor,
                  GLFWwindow* share),
                 (width, height, title, monitor, share))
ISOCHRON_FORWARD(glfwDefaultWindowHints, (), ())
ISOCHRON_FORWARD(glfwDestroyWindow, (GLFWwindow * window), (window))
ISOCHRON_FORWARD(glfwGetEGLContext, (GLFWwindow * window), (window))
ISOCHRON_FORWARD(glfwGetEGLDisplay, (), ())
ISOCHRON_FORWARD(glfwGetFramebufferSize, (GLFWwindow * window, int* width, int* height),
                 (window, width, height))
ISOCHRON_FORWARD(glfwGetGamepadState, (int jid, GLFWgamepadstate* state), (jid, state))
ISOCHRON_FORWARD(glfwGetMonitorContentScale, (GLFWmonitor * monitor, float* xscale, float* yscale),
                 (monitor, xscale, yscale))
ISOCHRON_FORWARD(glfwGetMonitorPos, (GLFWmonitor * monitor, int* xpos, int* ypos),
                 (monitor, xpos, ypos))
ISOCHRON_FORWARD(glfwGetMonitorWorkarea,
                 (GLFWmonitor * monitor, int* xpos, int* ypos, int* width, int* height),
                 (monitor, xpos, ypos, width, height))
ISOCHRON_FORWARD(glfwGetMonitors, (int* count), (count))
ISOCHRON_FORWARD(glfwGetPrimaryMonitor, (), ())
ISOCHRON_FORWARD(glfwGetProcAddress, (const char* procname), (procname))
ISOCHRON_FORWARD(glfwGetVersionString, (), ())
ISOCHRON_FORWARD(glfwGetVideoMode, (GLFWmonitor * monitor), (monitor))
ISOCHRON_FORWARD(glfwGetWindowAttrib, (GLFWwindow * window, int attrib), (window, attrib))
ISOCHRON_FORWARD(glfwGetWindowContentScale, (GLFWwindow * window, float* xscale, float* yscale),
                 (window, xscale, yscale))
ISOCHRON_FORWARD(glfwGetWindowMonitor, (GLFWwindow * window), (window))
ISOCHRON_FORWARD(glfwGetWindowPos, (GLFWwindow * window, int* xpos, int* ypos),
                 (window, xpos, ypos))
ISOCHRON_FORWARD(glfwGetWindowSize, (GLFWwindow * window, int* width, int* height),
                 (window, width, height))
ISOCHRON_FORWARD(glfwGetWindowUserPointer, (GLFWwindow * window), (window))
ISOCHRON_FORWARD(glfwInit, (), ())
ISOCHRON_FORWARD(glfwJoystickIsGamepad, (int jid), (jid))
ISOCHRON_FORWARD(glfwMakeContextCurrent, (GLFWwindow * window), (window))
ISOCHRON_FORWARD(glfwPollEvents, (), ())
ISOCHRON_FORWARD(glfwSetCharCallback, (GLFWwindow * window, GLFWcharfun callback),
                 (window, callback))
ISOCHRON_FORWARD(glfwSetClipboardString, (GLFWwindow * window, const char* string),
                 (window, string))
ISOCHRON_FORWARD(glfwSetCursorPosCallback, (GLFWwindow * window, GLFWcursorposfun callback),
                 (window, callback))
ISOCHRON_FORWARD(glfwSetDropCallback, (GLFWwindow * window, GLFWdropfun callback),
                 (window, callback))
ISOCHRON_FORWARD(glfwSetErrorCallback, (GLFWerrorfun callback), (callback))
ISOCHRON_FORWARD(glfwSetFramebufferSizeCallback,
                 (GLFWwindow * window, GLFWframebuffersizefun callback), (window, callback))
ISOCHRON_FORWARD(glfwSetKeyCallback, (GLFWwindow * window, GLFWkeyfun callback), (window, callback))
ISOCHRON_FORWARD(glfwSetMouseButtonCallback, (GLFWwindow * window, GLFWmousebuttonfun callback),
                 (window, callback))
ISOCHRON_FORWARD(glfwSetScrollCallback, (GLFWwindow * window, GLFWscrollfun callback),
                 (window, callback))
ISOCHRON_FORWARD(glfwSetWindowCloseCallback, (GLFWwindow * window, GLFWwindowclosefun callback),
                 (window, callback))
ISOCHRON_FORWARD(glfwSetWindowFocusCallback, (GLFWwindow * window, GLFWwindowfocusfun callback),
                 (window, callback))
ISOCHRON_FORWARD(glfwSetWindowMonitor,
                 (GLFWwindow * window, GLFWmonitor* monitor, int xpos, int ypos, int width,
                  int height, int refreshRate),
                 (window, monitor, xpos, ypos, width, height, refreshRate))
ISOCHRON_FORWARD(glfwSetWindowPos, (GLFWwindow * window, int xpos, int ypos), (window, xpos, ypos))
ISOCHRON_FORWARD(glfwSetWindowRefreshCallback, (GLFWwindow * window, GLFWwindowrefreshfun callback),
                 (window, callback))
ISOCHRON_FORWARD(glfwSetWindowShouldClose, (GLFWwindow * window, int value), (window, value))
ISOCHRON_FORWARD(glfwSetWindowUserPointer, (GLFWwindow * window, void* pointer), (window, pointer))
ISOCHRON_FORWARD(glfwShowWindow, (GLFWwindow * window), (window))
ISOCHRON_FORWARD(glfwSwapBuffers, (GLFWwindow * window), (window))
ISOCHRON_FORWARD(glfwSwapInterval, (int interval), (interval))
ISOCHRON_FORWARD(glfwTerminate, (), ())
ISOCHRON_FORWARD(glfwWaitEventsTimeout, (double timeout), (timeout))
ISOCHRON_FORWARD(glfwWindowHint, (int hint, int value), (hint, value))
ISOCHRON_FORWARD(glfwWindowShouldClose, (GLFWwindow * window), (window))
} // extern "C"
