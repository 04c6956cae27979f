// Waits for something that takes an unknown time, such as a picture on a screen.
#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace isochron::test_support {

/// The longest that a test waits for anything; only what hangs takes so long. It is the same
/// everywhere, and a little less than CTest's own limit, so that a test still says what did not
/// come.
constexpr std::chrono::minutes kPatience{4};

/// Waits until `holds` returns true, which may do some work each time. Sleeps in between, so that
/// the processor is free for what it waits for. @return false if it does not within `kPatience`
inline bool eventually(const std::function<bool()>& holds) {
    constexpr std::chrono::milliseconds kPause{5};
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    while (!holds()) {
        if (std::chrono::steady_clock::now() > deadline)
            return false;
        std::this_thread::sleep_for(kPause);
    }
    return true;
}

/// Waits at a condition variable until `holds` returns true. @return false if it does not within
/// `kPatience`
template <class Condition, class Lock, class Holds>
bool is_told(Condition& condition, Lock& lock, const Holds& holds) {
    return condition.wait_for(lock, kPatience, holds);
}

} // namespace isochron::test_support
