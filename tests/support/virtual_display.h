// An X server without a screen, with simulated input and window operations.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <sys/types.h>
#include <vector>

namespace isochron::test_support {

/// Starts Xvfb (1280x1024, no window manager) on a free display and sets DISPLAY to it until
/// destroyed. Windows are found by title. Everything throws std::runtime_error on failure.
class VirtualDisplay {
  public:
    VirtualDisplay();
    ~VirtualDisplay();
    VirtualDisplay(const VirtualDisplay&) = delete;
    VirtualDisplay& operator=(const VirtualDisplay&) = delete;

    /// Input as from a real keyboard and mouse: `{"key", "a"}`, `{"mousemove", "10", "20"}`, ...
    void xdotool(std::vector<std::string> arguments) const;
    /// Waits until the program whose window's title begins so has taken all input up to now and
    /// drawn a frame with it, or the window is gone. Windows of GLFW can tell.
    void await_frame(const std::string& begin) const;
    void resize_window(const std::string& title, int width, int height) const;
    /// Asks the window to close, like its close button.
    void close_window(const std::string& title) const;
    /// Drags a file from another program and drops it onto the window, by the XDND protocol that
    /// desktops' file managers speak. Waits until the window has taken it.
    void drop_file(const std::string& title, const std::string& path) const;
    /// The text that a program has given to the clipboard; empty: there is none.
    std::string clipboard() const;
    /// The server is killed, and the connections of all programs to it are cut.
    void die();
    /// Sets the resolution that programs which start from now on are told (Xft.dpi).
    void set_dots_per_inch(int dots) const;
    /// Red, green and blue of a pixel on the display, (0, 0) at the top left.
    std::array<int, 3> pixel(int x, int y) const;

  private:
    struct Connection;
    pid_t server_ = -1;
    std::unique_ptr<Connection> connection_;
};

} // namespace isochron::test_support
