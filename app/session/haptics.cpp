// Which presses of buttons are felt.
#include "app/session/haptics.h"

#include "interaction/actions.h"

#include <utility>

namespace isochron::app {
namespace {

using interaction::WandButton;

constexpr double kShort = 0.02, kLong = 0.04; ///< [s]
constexpr float kLight = 0.4f, kFirm = 0.8f;

} // namespace

std::vector<interaction::HapticPulse> Haptics::update(const interaction::InputState& input) {
    std::vector<interaction::HapticPulse> pulses;
    for (const char* name : {"wand", "wand2"}) {
        const interaction::DeviceState* hand = input.find(name);
        const std::uint64_t now = hand ? hand->buttons : 0;
        const std::uint64_t before = std::exchange(before_[name], now);
        const bool tracked = hand && hand->pose && hand->pose_valid;
        if (tracked && (now & ~before & bit(WandButton::grab)))
            pulses.push_back({name, kLong, kFirm});
        if (tracked && (before & ~now & bit(WandButton::teleport)))
            pulses.push_back({name, kShort, kLight});
    }
    return pulses;
}

} // namespace isochron::app
