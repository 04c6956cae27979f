// What the hands of a headset's wearer can do, and on which controllers' buttons that lies.
#pragma once

#include "interaction/actions.h"
#include "interaction/pose.h"
#include "stereo/openxr/openxr_instance.h"

#include <openxr/openxr.h>

#include <array>
#include <string_view>
#include <vector>

namespace isochron::stereo {

/// The hand that points, and the one that helps: devices `wand` and `wand2`.
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

/// One suggestion to the runtime, whose user may choose otherwise.
struct HandBinding {
    std::string_view profile; ///< `oculus/touch_controller`
    HandAction action;
    Hand hand;
    std::string_view path; ///< `input/squeeze/value`; with `|`: of the left, of the right hand
};
std::span<const HandBinding> hand_bindings();

/// `squeeze/value` of `a/click|b/click` for one hand; empty where that hand has none.
std::string_view path_on(const HandBinding& binding, bool left);

class OpenXrActions {
  public:
    /// Makes them known to the runtime, once for an instance.
    OpenXrActions(const OpenXrInstance& instance, bool left_handed);
    ~OpenXrActions();
    OpenXrActions(const OpenXrActions&) = delete;
    OpenXrActions& operator=(const OpenXrActions&) = delete;

    /// Once for each session.
    void attach(XrSession session);
    /// Takes in what the hands do now. @return false while another program has the input
    bool sync(XrSession session) const;

    /// Whether the hand holds something that is bound.
    bool has(XrSession session, Hand hand) const;
    bool pressed(XrSession session, HandAction action, Hand hand) const;
    /// -1 to 1, 0 where nothing is bound.
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
