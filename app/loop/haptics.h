// Haptic pulses for what a hand does.
#pragma once

#include "interaction/commands.h"
#include "interaction/input/device_reading.h"

#include <vector>

namespace isochron::app {

/// A tracked hand feels when a grab begins and when it teleports. Pulses for picking and pressing
/// come with the commands instead.
class Haptics {
  public:
    /// Pulses of this frame.
    std::vector<interaction::HapticPulse> update(const interaction::InputState& input);

  private:
    interaction::ButtonLevels before_;
};

} // namespace isochron::app
