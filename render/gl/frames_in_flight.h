// Keeps the GPU from falling behind, so that the shown picture is not too old.
#pragma once

#include "render/gl/gl.h"

#include <cstddef>
#include <deque>

namespace isochron::render {

/// If presenting a window already holds frames back, this never waits. It waits without a window,
/// or if the driver queues frames.
class FramesInFlight {
  public:
    /// Needs a driver that passes fences, see `passes_fences`; without, `end_frame` does nothing.
    explicit FramesInFlight(const Gl& gl);
    ~FramesInFlight();
    FramesInFlight(const FramesInFlight&) = delete;
    FramesInFlight& operator=(const FramesInFlight&) = delete;

    /// Call when all commands of a frame are given. Waits until the GPU has drawn all but the last
    /// kMost frames; at most a quarter of a second for each, so that the program still responds
    /// when the GPU hangs.
    void end_frame();
    static constexpr std::size_t kMost = 2;

  private:
    const Gl* gl_;
    bool fences_;
    std::deque<GLsync> frames_; ///< fences of frames that may not be drawn yet, oldest first
};

} // namespace isochron::render
