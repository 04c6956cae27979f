// Limits the frames in flight by a fence for each.
#include "render/gl/frames_in_flight.h"

#include "render/gl/driver_trials.h"

namespace isochron::render {

FramesInFlight::FramesInFlight(const Gl& gl) : gl_(&gl), fences_(passes_fences(gl)) {}

FramesInFlight::~FramesInFlight() {
    for (const GLsync frame : frames_)
        gl_->DeleteSync(frame);
}

void FramesInFlight::end_frame() {
    constexpr GLuint64 kLongest = 250'000'000; // [ns]
    if (!fences_)
        return;
    frames_.push_back(gl_->FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));
    while (!frames_.empty()) {
        const bool wait = frames_.size() > kMost;
        const GLenum state =
            gl_->ClientWaitSync(frames_.front(), GL_SYNC_FLUSH_COMMANDS_BIT, wait ? kLongest : 0);
        // After a timeout the fence is dropped, and not waited for again.
        if (state == GL_TIMEOUT_EXPIRED && !wait)
            return;
        gl_->DeleteSync(frames_.front());
        frames_.pop_front();
    }
}

} // namespace isochron::render
