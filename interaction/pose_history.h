// The recent poses of a device, and its velocity estimated from them.
#pragma once

#include "interaction/pose.h"

#include <deque>

namespace isochron::interaction {

/// Keeps the poses of the last moments. The velocity is 0 while they span less than `shortest`.
class PoseHistory {
  public:
    /// @param window how long poses are remembered; at least two are
    /// @param shortest time between two poses from which a velocity rises above the noise
    PoseHistory(Seconds window, Seconds shortest) : window_(window), shortest_(shortest) {}
    /// Adds a pose; one that is not later than the newest replaces the newest.
    void add(Seconds time, const Pose& pose);
    void forget() { samples_.clear(); }

    /// Slope of the least-squares line through the window: averages tracker noise away.
    Velocity steady() const;
    /// Velocity since the newest pose that is at least `shortest` old: reacts quickly, but noisier.
    Velocity sudden() const;

  private:
    struct Sample {
        Seconds time;
        Pose pose;
    };
    bool too_short() const;

    Seconds window_, shortest_;
    std::deque<Sample> samples_;
};

} // namespace isochron::interaction
