// The colors of pictures with opacity.
#include "render/gl/image.h"

#include "render/gl/srgb.h"

#include <algorithm>
#include <cmath>

namespace isochron::render {

void unmix_black(Image& image) {
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        const float opacity = static_cast<float>(image.rgba[i + 3]) / 255.0f;
        if (opacity == 0.0f || opacity == 1.0f)
            continue;
        for (std::size_t channel = i; channel < i + 3; ++channel) {
            const float mixed = linear_from_srgb(static_cast<float>(image.rgba[channel]) / 255.0f);
            const float alone = srgb_from_linear(std::min(1.0f, mixed / opacity));
            image.rgba[channel] = static_cast<std::uint8_t>(std::lround(255.0f * alone));
        }
    }
}

} // namespace isochron::render
