// Finds a device by its name; names of tracking states.
#include "interaction/input/tracked_input.h"

namespace isochron::interaction {

Tracking DeviceState::tracking() const {
    if (pose_lost)
        return Tracking::lost;
    return pose_valid ? Tracking::tracked : Tracking::held;
}

std::string_view name_of(Tracking tracking) {
    switch (tracking) {
    case Tracking::tracked: return "tracked";
    case Tracking::held: return "held";
    case Tracking::lost: return "lost";
    }
    return {};
}

const DeviceState* InputState::find(std::string_view name) const {
    const auto found = std::ranges::find(devices, name, &DeviceState::name);
    return found == devices.end() ? nullptr : &*found;
}

} // namespace isochron::interaction
