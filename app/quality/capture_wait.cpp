// Decides when a wanted capture is taken.
#include "app/quality/capture_wait.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace isochron::app {

CaptureView CaptureView::of(const FrameReport& frame, bool failed) {
    return {.time = frame.time,
            .asked = frame.asked,
            .shown = frame.shown,
            .failed = failed,
            .final = frame.final,
            .improves = frame.pace == interaction::Pace::settled &&
                        (frame.extracting || frame.draws_parts)};
}

void CaptureWait::ask() {
    if (wanted_++ > 0)
        return;
    before_.reset();
    waited_ = {};
}

std::string CaptureWait::note() const {
    return wanted_ == 0   ? ""
           : wanted_ == 1 ? "saving a picture, as soon as it is exact"
                          : fmt::format("saving {} pictures, as soon as they are exact", wanted_);
}

bool CaptureWait::take(const CaptureView& now) {
    if (wanted_ == 0)
        return false;
    const auto before = std::exchange(before_, now);
    if (!before || before->asked != now.asked)
        asked_since_ = now.time;
    const bool under_way = (!now.has_cells() || now.improves) && now.time - asked_since_ >= kSteady;
    if (before && !under_way)
        waited_ += std::min(now.time - before->time, kOfFrame);
    if (!now.is_final() && (under_way || waited_ < kPatience))
        return false;
    --wanted_;
    return true;
}

} // namespace isochron::app
