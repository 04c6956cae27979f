// Combines several input sources into one.
#include "interaction/input/composite_input.h"

#include <algorithm>

namespace isochron::interaction {

DeviceState merged(const DeviceState& first, const DeviceState& second) {
    DeviceState result = first;
    if (!first.pose && second.pose) {
        result.pose = second.pose;
        // A device that never has a pose, such as buttons, has lost nothing.
        if (first.pose_valid) {
            result.pose_valid = second.pose_valid;
            result.pose_lost = second.pose_lost;
            result.velocity = second.velocity;
            result.measured = second.measured;
            result.device_time = second.device_time;
        }
    }
    result.buttons |= second.buttons;
    result.actions |= second.actions;
    result.valuators.resize(std::max(first.valuators.size(), second.valuators.size()), 0.0f);
    for (std::size_t i = 0; i < second.valuators.size(); ++i)
        if (result.valuators[i] == 0.0f)
            result.valuators[i] = second.valuators[i];
    return result;
}

InputState merged(InputState first, const InputState& second) {
    for (const DeviceState& device : second.devices) {
        const auto found = std::ranges::find(first.devices, device.name, &DeviceState::name);
        if (found == first.devices.end())
            first.devices.push_back(device);
        else
            *found = merged(*found, device);
    }
    return first;
}

InputState CompositeInput::poll(Seconds now) {
    InputState all{now, {}};
    for (const auto& source : sources_)
        all = merged(std::move(all), source->poll(now));
    return all;
}

void CompositeInput::begin() {
    for (const auto& source : sources_)
        source->begin();
}

InputState CompositeInput::latch(Seconds now) {
    InputState all{now, {}};
    for (const auto& source : sources_)
        all = merged(std::move(all), source->latch(now));
    return all;
}

std::vector<std::string> CompositeInput::status() const {
    std::vector<std::string> lines;
    for (const auto& source : sources_) {
        const auto more = source->status();
        lines.insert(lines.end(), more.begin(), more.end());
    }
    return lines;
}

} // namespace isochron::interaction
