// Maps the time stamps of a device's own clock to session time.
#pragma once

#include "interaction/pose.h"

#include <optional>

namespace isochron::interaction {

/// A device stamps its samples evenly, a network delivers them late by varying times. The least
/// delay of the last seconds is the best guess at the clocks' difference, so a sample is dated by
/// its own stamp plus that difference. The guess starts over when a stamp is far from it: the
/// device's clock has been set, or has passed midnight.
class DeviceClock {
  public:
    /// @param stamp time by the device's clock, finite
    /// @param arrival session time when the sample came in
    /// @return session time of the stamp; never later than `arrival`
    Seconds session_time(Seconds stamp, Seconds arrival);

  private:
    /// The least difference, session minus device time, since some arrival.
    struct Least {
        Seconds since, difference;
    };
    Seconds difference() const;
    std::optional<Least> current_, before_;
};

} // namespace isochron::interaction
