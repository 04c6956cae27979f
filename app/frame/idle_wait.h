// Decides when the live loop may wait until something happens, as its next frame would be the same.
#pragma once

#include "interaction/pose.h"

#include <limits>
#include <optional>

namespace isochron::app {

/// What a frame tells about the next one.
struct FrameOutlook {
    static constexpr interaction::Seconds kNever{std::numeric_limits<double>::infinity()};

    /// The next frame is due at once: something is held, plays, is drawn in parts or extracted.
    bool busy = false;
    bool changed = false;                ///< this frame took or showed something new
    bool final = false;                  ///< its picture will not get better by itself
    interaction::Seconds until = kNever; ///< session time at which it changes by itself
};

/// Two outlooks as one: the picture's outlook and the outlook of the panel over it, for example.
FrameOutlook both(const FrameOutlook& one, const FrameOutlook& other);

/// After a change a few more frames are made, as the panel lays some things out a frame late. A
/// picture that is not final gets more of them: some choices count frames, and a few wait for a
/// moment of rest. If none of these frames has changed anything, no later one will.
class IdleWait {
  public:
    static constexpr int kFramesAfter = 3;
    static constexpr int kFramesUnfinished = 120;
    static constexpr interaction::Seconds kUnfinished{2}; ///< least time of those

    /// Called once a frame. @param now session time
    /// @return how long to wait before the next frame, 0 or more; empty: not at all
    std::optional<interaction::Seconds> after(const FrameOutlook& frame, interaction::Seconds now);
    /// Something ended a wait before its time: that counts as a change.
    void woken() { quiet_since_.reset(); }

  private:
    int quiet_ = 0; ///< frames without a change
    std::optional<interaction::Seconds> quiet_since_;
};

} // namespace isochron::app
