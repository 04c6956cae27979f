// The window system may go away under a program that shows windows on it.
#pragma once

#include <functional>
#include <memory>

namespace isochron::stereo {

/// While one lives, its function is called once when the connection to the X server ends, to save
/// what there is; then the program ends with status 1. The function must not draw. Without one, the
/// program just ends, with a line. One at a time.
class DisplayLoss {
  public:
    explicit DisplayLoss(std::function<void()> save);
    ~DisplayLoss();
    DisplayLoss(const DisplayLoss&) = delete;
    DisplayLoss& operator=(const DisplayLoss&) = delete;
};

/// The connection to the display while a window is open, else null. While the result lives, the
/// next window uses the same connection: a connection for each window fails once in some hundred
/// times, and an X server may reset itself when its last one ends.
std::shared_ptr<const void> open_display();

/// Lets a loss be noticed: once, after the window system's library was loaded.
void watch_display();

} // namespace isochron::stereo
