// Measures how long the GPU works on a part of each frame, and never waits for it.
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

/// A ring of pairs of GL_TIMESTAMP queries, read only once their results are there. Timestamps and
/// not GL_TIME_ELAPSED: they nest with other measurements, and llvmpipe's first elapsed time is the
/// time since the machine started. On llvmpipe the span is true wall-clock time of vertex and
/// fragment work, from the first command's execution to the last one's.
class GpuTimer {
  public:
    using Clock = std::chrono::steady_clock;

    struct Span {
        std::uint64_t tag = 0;
        /// Empty when the driver's answer cannot be true.
        std::optional<std::chrono::nanoseconds> time;
    };

    explicit GpuTimer(const Gl& gl);

    /// Opens the span that `end` closes.
    /// @param tag comes back with the result
    /// @return false, and nothing is measured, when the timer does not work or the GPU is further
    /// behind than the ring is long
    bool begin(std::uint64_t tag, Clock::time_point now);
    void end(); ///< does nothing unless `begin` returned true

    /// The oldest span whose result is there, each once.
    std::optional<Span> take(Clock::time_point now);

    /// False where the driver has no timestamps, or too many answers in a row could not be true:
    /// a stamp of zero, an end before its beginning, a span longer than the time that has passed.
    bool works() const { return works_; }

  private:
    struct Slot {
        explicit Slot(const Gl& gl) : start(gl, GL_TIMESTAMP), end(gl, GL_TIMESTAMP) {}
        Query start, end;
        std::uint64_t tag = 0;
        Clock::time_point begun;
    };
    static constexpr std::size_t kSlots = 6; ///< frames that a driver may be behind

    std::optional<std::chrono::nanoseconds> read(const Slot& slot, Clock::time_point now) const;

    const Gl* gl_;
    std::array<Slot, kSlots> slots_;
    std::size_t next_ = 0;    ///< to be begun
    std::size_t waiting_ = 0; ///< closed spans whose results are not taken, the slots before next_
    bool open_ = false;
    bool works_ = false;
    int impossible_ = 0; ///< answers in a row
};

} // namespace isochron::render
