// A headset's part in the live loop: its frames, its devices, haptic pulses, and its end.
#pragma once

#include "app/loop/haptics.h"
#include "stereo/headset.h"

#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// Does nothing without a headset.
class HeadsetLoop {
  public:
    /// @param headset attached, outlives the loop; or null
    explicit HeadsetLoop(stereo::Headset* headset) : headset_(headset) {}

    /// Handles the runtime's events and begins a frame; this may block. Prints a line on stderr for
    /// each change of the headset's state.
    void begin_frame(interaction::Seconds now);
    /// Time between two pictures while the headset paces the program; else empty.
    std::optional<interaction::Seconds> period() const { return period_; }
    /// Puts the headset's devices before all others, and sends haptic pulses for them.
    interaction::InputState with_devices(interaction::InputState others, interaction::Seconds now);
    void feel(const std::vector<interaction::HapticPulse>& pulses);
    bool ended() const { return state_ == stereo::HeadsetState::ended; }
    void leave();
    std::vector<std::string> status() const;

  private:
    void tell_changes();

    stereo::Headset* headset_;
    stereo::HeadsetState state_ = stereo::HeadsetState::idle;
    std::string told_;
    std::optional<interaction::Seconds> period_;
    Haptics haptics_;
};

} // namespace isochron::app
