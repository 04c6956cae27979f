// The wearer's head and hands as tracked devices.
#pragma once

#include "interaction/trackers/tracked_device.h"
#include "stereo/openxr/openxr_actions.h"
#include "stereo/openxr/openxr_session.h"

#include <array>
#include <vector>

namespace isochron::stereo {

/// Poses are for the time at which the picture will be visible: the runtime has predicted them, so
/// they are not predicted again. `device_time` is that time by the runtime's clock.
///
/// A head counts as tracked while its direction is measured and its place is known, even if only by
/// a model of the neck; a hand, as it moves things, only while both are measured. Else the pose is
/// held, and lost after a while, as with any tracker. A hand's device appears when it is first
/// seen.
class OpenXrInput {
  public:
    OpenXrInput();
    /// @param session running; null: poses are held, and nothing is pressed
    interaction::InputState poll(interaction::Seconds now, const OpenXrSession* session,
                                 const OpenXrActions* actions);
    /// The reference space moves at this display time: poses measured before it are no longer
    /// valid.
    void recenter_at(XrTime time) { recentered_at_ = time; }
    /// Forgets all poses, as everything may have moved.
    void forget();
    std::vector<std::string> status() const;

  private:
    void poll_head(interaction::Seconds now, const OpenXrSession& session);
    void poll_hand(interaction::Seconds now, const OpenXrSession& session,
                   const OpenXrActions& actions, Hand hand);
    void poll_keys(const OpenXrSession& session, const OpenXrActions& actions);

    interaction::TrackedDevice head_;
    std::array<interaction::TrackedDevice, kHands.size()> hands_;
    std::array<bool, kHands.size()> seen_{};
    interaction::ActionSet keys_;
    std::optional<XrTime> recentered_at_;
};

/// Name of a hand's device.
std::string name_of(Hand hand);

} // namespace isochron::stereo
