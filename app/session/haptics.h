// What a hand feels when it takes hold of something.
#pragma once

#include "interaction/commands.h"
#include "interaction/device_reading.h"

#include <vector>

namespace isochron::app {

/// A tracked hand feels its grab begin and the spot that it teleports to; what it picks and presses
/// comes with the commands.
class Haptics {
  public:
    /// Pulses of this frame.
    std::vector<interaction::HapticPulse> update(const interaction::InputState& input);

  private:
    interaction::ButtonLevels before_;
};

} // namespace isochron::app
