// How much to draw in each frame of a picture that is drawn in parts, over several frames.
#pragma once

#include "app/frame/milliseconds.h"

#include <cstddef>

namespace isochron::app {

/// Each frame draws one or more pieces. A piece is meant to take a quarter of a frame's time,
/// judged by the last piece, and has at most twice its work. So a frame takes longer than it may
/// only if the same work suddenly takes much longer than in the piece before.
class PartPace {
  public:
    static constexpr std::size_t kFirst = 1024, kLeast = 256; ///< units of work

    /// @param each time that this frame may take
    void begin_frame(Milliseconds each);
    /// Work of the next piece in this frame; 0: the frame has had its time.
    std::size_t next() const;
    /// Adds the time of a piece. @param work 0: the time was spent on something else
    void took(std::size_t work, Milliseconds time);

    /// Time of all pieces.
    Milliseconds whole() const { return whole_; }

  private:
    Milliseconds each_{0}, spent_{0}, whole_{0};
    Milliseconds of_one_{0};    ///< time of a unit of work, in the last piece
    std::size_t last_ = kFirst; ///< work of the last piece
    bool begun_ = false;        ///< this frame has had a piece
};

} // namespace isochron::app
