// Maps the time stamps of a device's own clock to session time.
#include "interaction/trackers/device_clock.h"

#include <algorithm>

namespace isochron::interaction {
namespace {

constexpr Seconds kWindow{1.0};      ///< clocks drift by less than 0.1 ms in that time
constexpr Seconds kAnotherTime{0.1}; ///< a sample that is delayed by more is of no use

} // namespace

Seconds DeviceClock::difference() const {
    return before_ ? std::min(before_->difference, current_->difference) : current_->difference;
}

Seconds DeviceClock::session_time(Seconds stamp, Seconds arrival) {
    const Seconds seen = arrival - stamp;
    const bool another_time =
        current_ && (seen - difference() > kAnotherTime || difference() - seen > kAnotherTime);
    if (!current_ || another_time) {
        before_.reset();
        current_ = Least{arrival, seen};
    } else if (arrival - current_->since > kWindow) {
        before_ = current_;
        current_ = Least{arrival, seen};
    } else {
        current_->difference = std::min(current_->difference, seen);
    }
    return stamp + difference();
}

} // namespace isochron::interaction
