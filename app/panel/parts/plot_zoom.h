// The part of a plot's range that is seen.
#pragma once

#include <algorithm>
#include <cmath>

namespace isochron::app {

/// The part of the range that is seen, as shares of it.
struct Zoom {
    float low = 0.0f, high = 1.0f;

    bool is_whole() const { return low <= 0.0f && high >= 1.0f; }
    /// Nearer or farther about a place in the plot. @param at 0 to 1
    void turn(float notches, float at) {
        constexpr float kNotch = 1.25f, kNearest = 1.0f / 128;
        const float width = std::clamp((high - low) / std::pow(kNotch, notches), kNearest, 1.0f);
        const float middle = std::lerp(low, high, at);
        low = std::clamp(middle - at * width, 0.0f, 1.0f - width);
        high = low + width;
    }
};

} // namespace isochron::app
