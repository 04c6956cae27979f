// Maps the time stamps of a device's own clock to session time.
#pragma once

#include "interaction/pose.h"

#include <optional>

namespace isochron::interaction {

/// A device stamps its samples evenly, but a network delivers them with varying delays. The
/// smallest difference between arrival and stamp in the last 1 to 2 s is the best estimate of the
/// difference between the clocks; a sample's time is its stamp plus that. The estimate starts over
/// when a stamp is more than 0.1 s off: the device's clock has been set, or has passed midnight.
class DeviceClock {
  public:
    /// @param stamp time by the device's clock, finite
    /// @param arrival session time when the sample came in
    /// @return session time of the stamp; never later than `arrival`
    Seconds session_time(Seconds stamp, Seconds arrival);

  private:
    /// The smallest difference, session minus device time, since an arrival.
    struct Least {
        Seconds since, difference;
    };
    Seconds difference() const;
    std::optional<Least> current_, before_;
};

} // namespace isochron::interaction
