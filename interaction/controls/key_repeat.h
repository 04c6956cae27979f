// Presses of a held key, which repeat.
#pragma once

#include "interaction/pose.h"

#include <algorithm>

namespace isochron::interaction {

/// Presses of one button, counted from its level and the clock.
struct KeyRepeat {
    static constexpr Seconds kDelay{0.4};     ///< a held key repeats after this
    static constexpr Seconds kInterval{0.05}; ///< and then this often
    bool was_down = false;
    Seconds next{0};

    int presses(bool down, Seconds now) {
        int count = 0;
        if (down && !was_down) {
            count = 1;
            next = now + kDelay;
        }
        for (; down && now >= next && count < 4; next += kInterval)
            ++count;
        next = std::max(next, now);
        was_down = down;
        return count;
    }
};

} // namespace isochron::interaction
