// How much of a picture that is drawn over several frames is drawn in each of them.
#pragma once

#include "app/frame/milliseconds.h"

#include <cstddef>

namespace isochron::app {

/// Each frame has several pieces of work, each of which is as large as the time of the last one
/// allows, and at least one. So a frame takes longer than its time only if work becomes much
/// dearer from one piece to the next: no piece has more than twice the work of the one before.
class SlicePace {
  public:
    static constexpr std::size_t kFirst = 1024, kLeast = 256; ///< work

    /// @param each time that a frame may take
    explicit SlicePace(Milliseconds each) : each_(each) {}

    void begin_frame();
    /// Work of the next piece in this frame; 0: the frame has had its time.
    std::size_t next() const;
    /// Adds a piece. @param work 0: it was something else
    void took(std::size_t work, Milliseconds time);

    /// Time of all pieces.
    Milliseconds whole() const { return whole_; }

  private:
    Milliseconds each_, spent_{0}, whole_{0};
    Milliseconds of_one_{0};    ///< time of a unit of work, in the last piece
    std::size_t last_ = kFirst; ///< work of the last piece
    bool begun_ = false;        ///< this frame has had a piece
};

} // namespace isochron::app
