// Whether to draw as suits a GPU or as suits a processor: what is fast on one is slow on the other.
#pragma once

#include <cstdint>

namespace isochron::render {

/// `automatic`: decided by the name of the driver's renderer.
enum class DrawnBy : std::uint8_t { automatic, gpu, processor };

} // namespace isochron::render
