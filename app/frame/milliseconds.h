// The unit of all measured stages.
#pragma once

#include <chrono>

namespace isochron::app {

using Milliseconds = std::chrono::duration<double, std::milli>;

} // namespace isochron::app
