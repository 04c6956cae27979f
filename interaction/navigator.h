// Hands, mouse, keys and gamepad move the volume: what navigation comes to in a frame.
#pragma once

#include "interaction/control_context.h"
#include "interaction/device_reading.h"
#include "interaction/navigation.h"

namespace isochron::interaction {

/// Where letting go of the teleport button would lead: what the wand points at on the floor. Empty
/// while nobody aims there.
std::optional<glm::dvec3> teleport_target(const InputState& input);

/// The viewer stays where the tracker says; what flies, turns and teleports is the volume, the
/// other way. Everything returns a valid similarity whose scale is within `kScaleRange` of home's.
class Navigator {
  public:
    static constexpr double kScaleRange = 1e3; ///< either way of the home scale

    /// @param seconds since the last frame, for rates
    Similarity update(const Reading& now, const ControlContext& context, double seconds);

  private:
    /// The clutch: the volume follows one hand, or two, as it lay when they closed around it.
    struct Grab {
        Pose hand;
        std::optional<Span> span;    ///< between two hands, when they closed
        std::optional<Span> newest;  ///< and in the last frame
        glm::dquat turn{1, 0, 0, 0}; ///< of the span since
        Similarity held;
        Similarity result; ///< what it led to; anything else moved the volume meanwhile
    };
    /// The hands that hold on: none, one, or both.
    struct Hands {
        std::optional<Pose> first;
        std::optional<Span> both;
    };

    std::optional<Similarity> chosen(const Reading& now, const ControlContext& context);
    Similarity stepped(const Reading& now, Similarity volume);
    Similarity teleported(const Reading& now, const Similarity& volume);
    Similarity held(const Hands& hands, const ControlContext& context, const Similarity& volume);
    static Hands closed_hands(const Reading& now);
    bool pressed(const Reading& now, Action action, WandButton button, GamepadButton pad) const;

    std::uint64_t last_keys_ = 0, last_pad_ = 0, last_wand_ = 0;
    bool turn_armed_ = true; ///< the turning valuator has been at rest since it last turned
    std::optional<glm::dvec3> teleport_target_;
    std::optional<Grab> grab_;
};

} // namespace isochron::interaction
