// Haptic pulses for presses of buttons.
#include "app/loop/haptics.h"

namespace isochron::app {
namespace {

using interaction::Reading;
using interaction::WandButton;

constexpr double kShort = 0.02, kLong = 0.04; ///< [s]
constexpr float kLight = 0.4f, kFirm = 0.8f;

} // namespace

std::vector<interaction::HapticPulse> Haptics::update(const interaction::InputState& input) {
    const Reading now(input, before_);
    std::vector<interaction::HapticPulse> pulses;
    const auto feel = [&](const interaction::DeviceState* hand, std::uint64_t before) {
        const std::uint64_t buttons = Reading::buttons(hand);
        if (!hand || !hand->pose || !hand->pose_valid)
            return;
        if (buttons & ~before & bit(WandButton::grab))
            pulses.push_back({hand->name, kLong, kFirm});
        if (before & ~buttons & bit(WandButton::teleport))
            pulses.push_back({hand->name, kShort, kLight});
    };
    feel(now.wand, now.before.wand);
    feel(now.other, now.before.other);
    before_ = now.levels();
    return pulses;
}

} // namespace isochron::app
