// The viewers' heads as they are right before drawing, whatever they were when the frame began.
#pragma once

#include "interaction/tracked_input.h"
#include "stereo/installation.h"

#include <functional>
#include <optional>

namespace isochron::app {

/// Asked once per frame, right before its views are made, for the newest poses: see
/// `interaction::TrackedInput::latch`. Its time is that of the asking.
using Latch = std::function<interaction::InputState()>;

/// Of what was latched, the heads of viewers that have a pose. Only heads are taken over: hands
/// must stay where the frame's navigation had them, or what they hold would slip.
interaction::InputState viewers_heads(const interaction::InputState& latched,
                                      const stereo::Installation& installation);

/// The frame's devices with these heads in their places: what the views are made of.
interaction::InputState with_heads(interaction::InputState input,
                                   const interaction::InputState& heads);

/// How old the oldest of the viewers' poses is, nothing where no head has one. What no tracker has
/// measured, but mouse and keyboard emulate, was measured when it was asked for.
/// @param seen what views are made of @param made when they are, session time
std::optional<interaction::Seconds> pose_age(const interaction::InputState& seen,
                                             interaction::Seconds made,
                                             const stereo::Installation& installation);

} // namespace isochron::app
