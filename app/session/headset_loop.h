// A headset's part in the live loop: its frames, its devices, what hands feel, and its end.
#pragma once

#include "app/session/haptics.h"
#include "stereo/headset.h"

#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// Does nothing where there is no headset.
class HeadsetLoop {
  public:
    /// @param headset attached, outlives the loop; or null
    explicit HeadsetLoop(stereo::Headset* headset) : headset_(headset) {}

    /// Follows the runtime and begins a frame, for which it may block. What becomes of the headset
    /// is told on stderr, a line for each change.
    /// @return whether the headset has paced the program
    bool begin_frame(interaction::Seconds now);
    /// Between two pictures, while the headset paces the program.
    std::optional<interaction::Seconds> period() const { return period_; }
    /// The headset's devices before all others; lets hands feel what they do.
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
