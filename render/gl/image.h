// A picture in memory, read back from the GPU or written to a file.
#pragma once

#include <cstdint>
#include <vector>

namespace isochron::render {

struct Image {
    int width = 0, height = 0;      ///< pixels
    std::vector<std::uint8_t> rgba; ///< 4 bytes per pixel, top row first

    /// The four bytes of a pixel, (0, 0) at the top left.
    const std::uint8_t* at(int x, int y) const {
        return rgba.data() + 4 * (static_cast<std::size_t>(y) * width + x);
    }
};

} // namespace isochron::render
