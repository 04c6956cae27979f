// The recent poses of one thing, and what velocity they show.
#pragma once

#include "interaction/pose.h"

#include <deque>

namespace isochron::interaction {

/// Poses of the last moments. Fewer than it takes to tell show no motion.
class PoseHistory {
  public:
    /// @param window of the poses that are remembered
    /// @param shortest time between poses that says anything above their noise
    PoseHistory(Seconds window, Seconds shortest) : window_(window), shortest_(shortest) {}
    /// A pose that is not later than the newest one takes its place.
    void add(Seconds time, const Pose& pose);
    void forget() { samples_.clear(); }

    /// Slope of the least-squares line through the window: averages tracker noise away.
    Velocity steady() const;
    /// From the newest pose that is `shortest` old: quick, and still above the noise.
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
