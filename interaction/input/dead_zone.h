// The dead zone of sticks, which do not quite return to the middle when they are let go.
#pragma once

#include <algorithm>
#include <cmath>

namespace isochron::interaction {

/// 0 within `zone` of the middle, rising linearly from there to 1 (or -1) at full deflection.
/// @param zone 0 to below 1
inline float past_dead_zone(float value, float zone) {
    const float size = std::min(std::abs(value), 1.0f);
    return size > zone ? std::copysign((size - zone) / (1.0f - zone), value) : 0.0f;
}

} // namespace isochron::interaction
