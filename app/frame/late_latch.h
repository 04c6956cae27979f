// Late latching: the viewers' heads right before drawing, newer than at the frame's begin.
#pragma once

#include "interaction/input/tracked_input.h"
#include "stereo/installation.h"

#include <functional>
#include <optional>

namespace isochron::app {

/// Returns the newest poses, see `interaction::TrackedInput::latch`, at the time of the call.
/// Called once per frame, right before its views are made (in a cluster: when the frame begins, so
/// that all walls get the same poses).
using Latch = std::function<interaction::InputState()>;

/// The latched heads of viewers, if they have a pose. Hands are left out: they must stay where the
/// frame's navigation had them, else the data that they hold would slip.
interaction::InputState viewers_heads(const interaction::InputState& latched,
                                      const stereo::Installation& installation);

/// The frame's devices with their heads replaced by these, for making the views.
interaction::InputState with_heads(interaction::InputState input,
                                   const interaction::InputState& heads);

/// Age of the oldest head pose of all viewers; empty if no head has a pose. A pose that no tracker
/// measured (mouse and keyboard emulate it) counts as measured when it was asked for.
/// @param seen devices that the views are made from @param made session time of making the views
std::optional<interaction::Seconds> pose_age(const interaction::InputState& seen,
                                             interaction::Seconds made,
                                             const stereo::Installation& installation);

} // namespace isochron::app
