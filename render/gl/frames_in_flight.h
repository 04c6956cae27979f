// Keeps the GPU from falling behind: what is shown would be ever older.
#pragma once

#include "render/gl/gl.h"

#include <cstddef>
#include <deque>

namespace isochron::render {

/// Where a window's presentation holds frames back this never waits; without a window, or where
/// the driver queues frames, it does.
class FramesInFlight {
  public:
    /// Asked for are fences that the driver passes, see `passes_fences`; else nothing ever waits.
    explicit FramesInFlight(const Gl& gl);
    ~FramesInFlight();
    FramesInFlight(const FramesInFlight&) = delete;
    FramesInFlight& operator=(const FramesInFlight&) = delete;

    /// The frame is handed over. Waits until the GPU has drawn all but the last kMost frames; for
    /// a quarter of a second at most, so that a GPU that hangs leaves the user a program that acts.
    void end_frame();
    static constexpr std::size_t kMost = 2;

  private:
    const Gl* gl_;
    bool fences_;
    std::deque<GLsync> frames_; ///< not known to be drawn, oldest first
};

} // namespace isochron::render
