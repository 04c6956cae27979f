// An X server without a screen, for windows that nobody needs to see.
#pragma once

#include <sys/types.h>

namespace isochron::bench {

/// Starts Xvfb on a free display, and sets DISPLAY to it as long as it lives.
class OwnDisplay {
  public:
    /// @throws index::Error when Xvfb does not start
    OwnDisplay();
    ~OwnDisplay();
    OwnDisplay(const OwnDisplay&) = delete;
    OwnDisplay& operator=(const OwnDisplay&) = delete;

  private:
    pid_t server_ = -1;
};

} // namespace isochron::bench
