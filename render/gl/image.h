// A picture in memory, read back from the GPU or written to a file.
#pragma once

#include <cstdint>
#include <vector>

namespace isochron::render {

struct Image {
    int width = 0, height = 0;      ///< pixels
    std::vector<std::uint8_t> rgba; ///< 4 bytes per pixel, top row first
    bool opaque = true;             ///< files that are written have no alpha
    double dpi = 0;                 ///< pixels an inch that files say; 0: nothing

    /// The four bytes of a pixel, (0, 0) at the top left.
    const std::uint8_t* at(int x, int y) const {
        return rgba.data() + 4 * (static_cast<std::size_t>(y) * width + x);
    }
};

/// Makes the colors of a picture that was drawn over nothing those of what was drawn, in the places
/// that it covers in part: colors were mixed with black there, in linear light.
void unmix_black(Image& image);

} // namespace isochron::render
