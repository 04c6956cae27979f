// What keys have done that the picture alone does not show, in words.
#pragma once

#include "interaction/control_context.h"
#include "interaction/input/device_reading.h"

#include <string>
#include <vector>

namespace isochron::interaction {

/// A line for each key that went down in this frame and changed such a setting, and for a teleport
/// that has ended. @param commands of the frame
std::vector<std::string> words_of_keys(const Reading& now, const ControlContext& context,
                                       const Commands& commands);

} // namespace isochron::interaction
