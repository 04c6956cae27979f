// Wakes a loop that waits for its windows, from any thread or from a signal handler.
//
//     const auto wake = std::make_shared<Wake>();
//     worker.set_wake([wake] { (*wake)(); });   // calls it when it has something to show
//     windows.wait(*wake, Seconds(30));         // returns once the worker, or the user, does something
#pragma once

#include <chrono>

namespace isochron::stereo {

/// Asks nothing of a window system: a thread that posted an event to an X server that is gone would
/// end the program in Xlib while the main thread draws or saves.
class Wake {
  public:
    Wake(); ///< @throws render::Error when the system has no descriptor left
    ~Wake();
    Wake(const Wake&) = delete;
    Wake& operator=(const Wake&) = delete;

    /// Ends the wait that goes on, or else the next one. Safe in a signal handler.
    void operator()() const noexcept;
    /// Wakes through the address, for callers that have nothing else, such as signal handlers.
    static void call(const void* wake) noexcept { (*static_cast<const Wake*>(wake))(); }
    /// Whether somebody has called it since the last time.
    bool take() const noexcept;
    /// Readable while `take` would return true.
    int descriptor() const { return descriptor_; }
    /// Waits until somebody calls it. Does not take that call.
    /// @param also another descriptor that ends the wait once there is something to read; -1: none
    /// @param longest time to wait, 0 or more
    void wait(int also, std::chrono::duration<double> longest) const noexcept;

  private:
    int descriptor_;
};

} // namespace isochron::stereo
