// The actions of a headset wearer's hands, and their bindings to controllers.
#pragma once

#include "interaction/input/actions.h"
#include "interaction/pose.h"
#include "stereo/openxr/openxr_instance.h"

#include <openxr/openxr.h>

#include <array>
#include <string_view>

namespace isochron::stereo {

/// A hand that points, and the other hand: devices `wand` and `wand2`.
enum class Hand : std::uint8_t { wand, other };
inline constexpr std::array kHands{Hand::wand, Hand::other};

enum class HandAction : std::uint8_t {
    aim,
    haptic,
    grab,
    fly,
    teleport,
    recenter,
    next_view,
    pick,
    fly_speed,
    turn,
    isovalue,
    step,
    play,
    reverse,
    panel,
    count
};

/// One suggested binding; the runtime's user may change it.
struct HandBinding {
    std::string_view profile; ///< `oculus/touch_controller`
    HandAction action;
    Hand hand;
    std::string_view path; ///< `input/squeeze/value`; with `|`: left hand | right hand
};
std::span<const HandBinding> hand_bindings();

/// The path for one hand: of `input/x/click|input/a/click` the part of that hand; may be empty.
std::string_view path_on(const HandBinding& binding, bool left);

class OpenXrActions {
  public:
    /// Creates the actions and suggests their bindings to the runtime.
    OpenXrActions(const OpenXrInstance& instance, bool left_handed);
    ~OpenXrActions();
    OpenXrActions(const OpenXrActions&) = delete;
    OpenXrActions& operator=(const OpenXrActions&) = delete;

    /// Attaches the actions to a session; call once per session.
    void attach(XrSession session);
    /// Updates the states of the actions. @return false while another program has the input
    bool sync(XrSession session) const;

    /// Whether the hand has a controller with bindings.
    bool has(XrSession session, Hand hand) const;
    bool pressed(XrSession session, HandAction action, Hand hand) const;
    /// Value of an action, -1 to 1; 0 if nothing is bound.
    float value(XrSession session, HandAction action, Hand hand) const;
    XrSpace aim(Hand hand) const { return aims_[static_cast<std::size_t>(hand)]; }
    void vibrate(XrSession session, Hand hand, interaction::Seconds duration,
                 float amplitude) const;

  private:
    XrAction action(HandAction which) const { return actions_[static_cast<std::size_t>(which)]; }
    XrActionStateGetInfo of(HandAction which, Hand hand) const;
    void make_action(const OpenXrInstance& instance, HandAction which);
    void suggest(const OpenXrInstance& instance) const;
    const char* user(Hand hand) const;

    bool left_handed_;
    XrActionSet set_ = XR_NULL_HANDLE;
    std::array<XrAction, static_cast<std::size_t>(HandAction::count)> actions_{};
    std::array<XrPath, kHands.size()> users_{};
    std::array<XrSpace, kHands.size()> aims_{};
};

} // namespace isochron::stereo
