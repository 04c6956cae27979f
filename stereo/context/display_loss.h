// The window system may go away under a program that shows windows on it.
#pragma once

#include <functional>

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

/// Lets a loss be noticed: once, after the window system's library was loaded.
void watch_display();

} // namespace isochron::stereo
