// How long work reports how far it is.
#pragma once

#include <functional>
#include <string_view>

namespace isochron::index {

/// Called now and then, from the thread that does the work, with the phase and its fraction done
/// in [0, 1]. Throwing from it cancels the work, which then leaves nothing behind.
using Progress = std::function<void(std::string_view phase, double fraction)>;

} // namespace isochron::index
