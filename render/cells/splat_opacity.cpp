// The optical depth of overlapping splats, and its inverse.
#include "render/cells/splat_opacity.h"

#include <cmath>
#include <numbers>

namespace isochron::render {

namespace {

/// The dilogarithm for x in [0, 1]; the upper half by Euler's reflection formula.
float dilogarithm(float x) {
    constexpr float kOfOne = std::numbers::pi_v<float> * std::numbers::pi_v<float> / 6.0f;
    if (x >= 1.0f)
        return kOfOne;
    if (x > 0.5f)
        return kOfOne - std::log(x) * std::log1p(-x) - dilogarithm(1.0f - x);
    float sum = 0.0f, power = x;
    for (int k = 1; k <= 20; ++k, power *= x)
        sum += power / static_cast<float>(k * k);
    return sum;
}

} // namespace

float splat_opacity(float surface_opacity, float sigma) {
    if (surface_opacity >= 1.0f)
        return 1.0f;
    constexpr float kCellsPerArea = 1.5f; // mean of |nx| + |ny| + |nz| over all directions
    const float depth = -std::log1p(-surface_opacity) /
                        (kCellsPerArea * 2.0f * std::numbers::pi_v<float> * sigma * sigma);
    float low = 0.0f, high = 1.0f;
    for (int halving = 0; halving < 20; ++halving) {
        const float middle = 0.5f * (low + high);
        (dilogarithm(middle) < depth ? low : high) = middle;
    }
    return high;
}

} // namespace isochron::render
