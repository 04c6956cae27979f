// Who draws: the ways of drawing that pay on a GPU are not those that pay on a processor.
#pragma once

#include <cstdint>

namespace isochron::render {

/// `automatic`: by what the driver says of itself.
enum class DrawnBy : std::uint8_t { automatic, gpu, processor };

} // namespace isochron::render
