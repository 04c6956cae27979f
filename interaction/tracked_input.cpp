// Looking a device up by name.
#include "interaction/tracked_input.h"

#include <algorithm>

namespace isochron::interaction {

const DeviceState* InputState::find(std::string_view name) const {
    const auto found = std::ranges::find(devices, name, &DeviceState::name);
    return found == devices.end() ? nullptr : &*found;
}

} // namespace isochron::interaction
