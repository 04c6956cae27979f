// Late latching of the viewers' heads.
#include "app/frame/late_latch.h"

#include <algorithm>

namespace isochron::app {

using interaction::DeviceState;
using interaction::InputState;
using interaction::Seconds;

InputState viewers_heads(const InputState& latched, const stereo::Installation& installation) {
    InputState heads{latched.time, {}};
    for (const DeviceState& device : latched.devices) {
        const bool sees = std::ranges::find(installation.viewers, device.name,
                                            &stereo::Viewer::head) != installation.viewers.end();
        if (!sees || !device.pose)
            continue;
        heads.devices.push_back(device);
        if (!device.measured)
            heads.devices.back().measured = latched.time;
    }
    return heads;
}

InputState with_heads(InputState input, const InputState& heads) {
    for (const DeviceState& head : heads.devices) {
        const auto found = std::ranges::find(input.devices, head.name, &DeviceState::name);
        if (found == input.devices.end())
            input.devices.push_back(head);
        else
            *found = head;
    }
    return input;
}

std::optional<Seconds> pose_age(const InputState& seen, Seconds made,
                                const stereo::Installation& installation) {
    std::optional<Seconds> oldest;
    for (const stereo::Viewer& viewer : installation.viewers)
        if (const DeviceState* head = seen.find(viewer.head); head && head->pose)
            oldest =
                std::max(oldest.value_or(Seconds(0)), made - head->measured.value_or(seen.time));
    return oldest;
}

} // namespace isochron::app
