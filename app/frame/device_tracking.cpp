// How well each device was tracked in a frame.
#include "app/frame/device_tracking.h"

#include <fmt/format.h>

namespace isochron::app {

using interaction::Tracking;

std::vector<DeviceTracking> tracking_of(const interaction::InputState& input) {
    std::vector<DeviceTracking> devices;
    for (const interaction::DeviceState& device : input.devices) {
        const Tracking tracking = device.tracking();
        if (!device.measured && tracking == Tracking::tracked)
            continue;
        DeviceTracking& state = devices.emplace_back();
        state.name = device.name;
        state.tracking = tracking;
        if (device.measured)
            state.age = input.time - *device.measured;
    }
    return devices;
}

std::string in_words(const DeviceTracking& device) {
    if (!device.age)
        return fmt::format("{}: not seen yet", device.name);
    if (device.tracking == Tracking::tracked)
        return fmt::format("{}: tracked, {:.0f} ms old", device.name, 1e3 * device.age->count());
    return fmt::format("{}: {} for {:.1f} s", device.name, name_of(device.tracking),
                       device.age->count());
}

} // namespace isochron::app
