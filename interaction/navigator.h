// Mouse, keys, stick and gamepad move the volume: what navigation comes to in a frame. What hands
// hold is the grab tool's.
#pragma once

#include "interaction/control_context.h"
#include "interaction/device_reading.h"
#include "interaction/navigation.h"

namespace isochron::interaction {

/// Where letting go of the teleport button would lead: what the wand points at on the floor. Empty
/// while nobody aims there.
std::optional<glm::dvec3> teleport_target(const InputState& input);

/// The viewer stays where the tracker says; what flies, turns and teleports is the volume, the
/// other way. Everything returns a valid similarity whose scale is within `kScaleRange`
/// of home's.
class Navigator {
  public:
    /// @param seconds since the last frame, for rates
    /// @param drag_taken the mouse's left drag is somebody else's
    Similarity update(const Reading& now, const ControlContext& context, double seconds,
                      bool drag_taken);

  private:
    static std::optional<Similarity> chosen(const Reading& now, const ControlContext& context);
    Similarity stepped(const Reading& now, Similarity volume);
    Similarity teleported(const Reading& now, const ControlContext& context,
                          const Similarity& volume);
    bool turn_armed_ = true; ///< the turning valuator has been at rest since it last turned
    std::optional<glm::dvec3> teleport_target_;
};

} // namespace isochron::interaction
