// Navigation: mouse, keys, sticks and gamepad move the volume. Holding it by hand is the grab
// tool's work.
#pragma once

#include "interaction/control_context.h"
#include "interaction/input/device_reading.h"

#include <vector>

namespace isochron::interaction {

/// The place on the floor to which releasing the teleport button would lead: under the eye's ray
/// through the cursor, or else under the wand's ray. Empty while the button is up or the ray meets
/// no floor.
std::optional<glm::dvec3> teleport_target(const InputState& input);

/// The viewer stays where the tracker says: to fly, turn or teleport, the volume moves the opposite
/// way. Results are valid similarities; scaling stays within a factor `kScaleRange` of the start.
class Navigator {
  public:
    /// @param seconds since the last frame, for rates
    /// @param drag_taken a tool takes the mouse's left drag
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

/// The viewpoints with a place in addition, under the next free name; without the oldest one if there
/// are kMostViews.
std::vector<Viewpoint> with_view(std::vector<Viewpoint> views, const Similarity& place);

} // namespace isochron::interaction
