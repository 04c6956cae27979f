// Waits for something that takes an unknown time, such as a picture on a screen.
#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace isochron::test_support {

/// Waits until `holds` returns true. @return false if it does not within a minute
inline bool eventually(const std::function<bool()>& holds) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!holds()) {
        if (std::chrono::steady_clock::now() > deadline)
            return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
}

} // namespace isochron::test_support
