// Decides when a wanted capture is taken.
#include "app/quality/capture_wait.h"

#include <utility>

namespace isochron::app {

bool CaptureWait::take(const CaptureView& now) {
    const auto before = std::exchange(before_, now);
    if (!before || before->asked != now.asked)
        asked_since_ = now.time;
    if (wanted_ == 0) {
        waited_ = {};
        return false;
    }
    const bool there = now.shown == now.asked || (now.failed && now.shown);
    const bool under_way = !there && now.time - asked_since_ >= kSteady;
    if (before && !under_way)
        waited_ += now.time - before->time;
    if (!(now.final && there) && (under_way || waited_ < kPatience))
        return false;
    --wanted_;
    return true;
}

} // namespace isochron::app
