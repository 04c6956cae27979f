// How well each device was tracked in a frame: for the panel and the report.
#pragma once

#include "interaction/input/tracked_input.h"

#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

struct DeviceTracking {
    std::string name;
    interaction::Tracking tracking = interaction::Tracking::tracked;
    std::optional<interaction::Seconds> age; ///< age of the measurement; empty: none has ever come
};

/// The devices that a tracker follows, without those that mouse and keyboard emulate.
std::vector<DeviceTracking> tracking_of(const interaction::InputState& input);

/// `head: tracked, 4 ms old`, `wand: lost for 3.2 s`, `wand: not seen yet`.
std::string in_words(const DeviceTracking& device);

} // namespace isochron::app
