// Waits for the window system's events.
#include "stereo/context/window_events.h"

#include "stereo/context/gl_context_glfw_native.h"
#include "stereo/context/glx_types.h"
#include "stereo/context/shared_library.h"

// Types of Xrandr, for which GLFW's header would include all of it.
using RRCrtc = XID;
using RROutput = XID;
#define GLFW_INCLUDE_NONE
#define GLFW_NATIVE_INCLUDE_NONE
#define GLFW_EXPOSE_NATIVE_X11
#include <GLFW/glfw3.h>
#include <GLFW/glfw3native.h>

#include <algorithm>
#include <chrono>

namespace isochron::stereo {
namespace {

using interaction::Seconds;
using Clock = std::chrono::steady_clock;

/// GLFW waits for the X server alone. So this waits for its connection and for `wake`.
bool wait_for_x_events(Display* display, const Wake& wake, Clock::time_point end) {
    static const auto pending = [] {
        int (*found)(Display*);
        SharedLibrary("libX11.so.6").get(found, "XPending");
        return found;
    }();
    while (!wake.take()) {
        // Drawing may have read events from the connection, which then is no longer readable.
        if (pending(display) > 0) {
            glfwPollEvents();
            return true;
        }
        const Seconds left = end - Clock::now();
        if (left <= Seconds(0))
            return false;
        wake.wait(ConnectionNumber(display), left);
    }
    return true;
}

/// Where GLFW tells of no descriptor to wait for: it waits, and `wake` is looked at meanwhile.
bool wait_for_other_events(const Wake& wake, Clock::time_point end) {
    constexpr Seconds kLook{0.05};
    while (!wake.take()) {
        const auto begun = Clock::now();
        const Seconds longest = std::min<Seconds>(kLook, end - begun);
        if (longest <= Seconds(0))
            return false;
        glfwWaitEventsTimeout(longest.count());
        if (Clock::now() - begun < longest)
            return true;
    }
    return true;
}

} // namespace

bool wait_for_window_events(const Wake& wake, Seconds longest) {
    constexpr Seconds kLongest{3600};
    const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                        std::clamp(longest, Seconds(0), kLongest));
    // A GLFW for Wayland alone lacks it.
    static const auto of_x11 =
        reinterpret_cast<decltype(&glfwGetX11Display)>(glfw_function("glfwGetX11Display"));
    Display* display = of_x11 ? of_x11() : nullptr;
    return display ? wait_for_x_events(display, wake, end) : wait_for_other_events(wake, end);
}

} // namespace isochron::stereo
