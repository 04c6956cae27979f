// Sticks that are let go do not quite return to the middle.
#pragma once

#include <algorithm>
#include <cmath>

namespace isochron::interaction {

/// 0 within `zone` of the middle, from there steadily to 1 (or -1) at full deflection.
/// @param zone 0 to below 1
inline float past_dead_zone(float value, float zone) {
    const float size = std::min(std::abs(value), 1.0f);
    return size > zone ? std::copysign((size - zone) / (1.0f - zone), value) : 0.0f;
}

} // namespace isochron::interaction
