// Measures how long the GPU works on a part of each frame, without waiting for it.
//
//     timer.begin(frame, Clock::now());
//     draw();
//     timer.end();
//     while (const auto span = timer.take(Clock::now()))   // of earlier frames
//         note(span->tag, span->time);
#pragma once

#include "render/gl/gl_objects.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace isochron::render {

/// A ring of pairs of GL_TIMESTAMP queries, which are read when their results are available. Uses
/// timestamps rather than GL_TIME_ELAPSED because they can be nested, and because llvmpipe's first
/// elapsed time is the time since the machine started. On llvmpipe the span is the wall-clock time
/// of vertex and fragment work, from the first command's execution to the last one's.
class GpuTimer {
  public:
    using Clock = std::chrono::steady_clock;

    struct Span {
        std::uint64_t tag = 0;
        /// Empty when the driver's answer cannot be true.
        std::optional<std::chrono::nanoseconds> time;
    };

    explicit GpuTimer(const Gl& gl);

    /// Begins the span that `end` ends.
    /// @param tag returned with the result
    /// @return false if nothing is measured: the timer does not work, or all slots of the ring
    /// still wait for the GPU
    bool begin(std::uint64_t tag, Clock::time_point now);
    void end(); ///< does nothing unless `begin` returned true

    /// The oldest span with a result; returns each span once.
    std::optional<Span> take(Clock::time_point now);

    /// False if the driver has no timestamps, or gave too many impossible answers in a row: a stamp
    /// of zero, an end before its beginning, a span longer than the time that has passed.
    bool works() const { return works_; }

  private:
    struct Slot {
        explicit Slot(const Gl& gl) : start(gl, GL_TIMESTAMP), end(gl, GL_TIMESTAMP) {}
        Query start, end;
        std::uint64_t tag = 0;
        Clock::time_point begun;
    };
    static constexpr std::size_t kSlots = 6; ///< most frames that the GPU may be behind

    std::optional<std::chrono::nanoseconds> read(const Slot& slot, Clock::time_point now) const;

    const Gl* gl_;
    std::array<Slot, kSlots> slots_;
    std::size_t next_ = 0;    ///< slot to begin next
    std::size_t waiting_ = 0; ///< ended spans without a taken result, in the slots before next_
    bool open_ = false;
    bool works_ = false;
    int impossible_ = 0; ///< impossible answers in a row
};

} // namespace isochron::render
