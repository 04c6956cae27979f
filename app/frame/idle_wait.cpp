// Decides when the live loop may wait until something happens.
#include "app/frame/idle_wait.h"

#include <algorithm>

namespace isochron::app {

using interaction::Seconds;

FrameOutlook both(const FrameOutlook& one, const FrameOutlook& other) {
    return {.busy = one.busy || other.busy,
            .changed = one.changed || other.changed,
            .final = one.final && other.final,
            .until = std::min(one.until, other.until)};
}

std::optional<Seconds> IdleWait::after(const FrameOutlook& frame, Seconds now) {
    if (frame.busy || frame.changed || !quiet_since_) {
        quiet_ = 0;
        quiet_since_ = now;
        return std::nullopt;
    }
    ++quiet_;
    const bool enough = frame.final
                            ? quiet_ >= kFramesAfter
                            : quiet_ >= kFramesUnfinished && now - *quiet_since_ >= kUnfinished;
    if (!enough)
        return std::nullopt;
    return std::max(frame.until - now, Seconds(0));
}

} // namespace isochron::app
