// Locates head and hands, and reads the hands' buttons.
#include "stereo/openxr/openxr_input.h"

#include "interaction/input/dead_zone.h"
#include "stereo/openxr/openxr_error.h"
#include "stereo/openxr/openxr_poses.h"

#include <algorithm>

namespace isochron::stereo {
namespace {

using interaction::Action;
using interaction::Seconds;
using interaction::WandButton;
using interaction::WandValuator;

constexpr float kDeadZone = 0.15f; ///< deflection of a thumbstick that counts as none
constexpr float kStepAt = 0.6f;    ///< deflection of a thumbstick that counts as a step

constexpr XrSpaceLocationFlags kKnown =
    XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_VALID_BIT;
constexpr XrSpaceLocationFlags kTurnMeasured = XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT;
constexpr XrSpaceLocationFlags kMeasured = kTurnMeasured | XR_SPACE_LOCATION_POSITION_TRACKED_BIT;
constexpr XrSpaceVelocityFlags kMoving =
    XR_SPACE_VELOCITY_LINEAR_VALID_BIT | XR_SPACE_VELOCITY_ANGULAR_VALID_BIT;

interaction::DeviceOptions options_of(std::string name) {
    interaction::DeviceOptions options;
    options.name = std::move(name);
    options.prediction.on = false;
    // The runtime has already filtered its poses, and an arm may move faster than a carried
    // tracker.
    options.limits.fastest = 20.0;
    options.limits.fastest_turn = 60.0;
    return options;
}

/// @param needed flags that the location must have, besides being known
void add_pose(interaction::TrackedDevice& device, Seconds now, const OpenXrSession& session,
              XrSpace space, XrSpaceLocationFlags needed) {
    XrSpaceVelocity velocity{XR_TYPE_SPACE_VELOCITY};
    XrSpaceLocation location{XR_TYPE_SPACE_LOCATION, &velocity};
    const XrTime time = *session.display_time();
    check(xrLocateSpace(space, session.room_space(), time, &location), "xrLocateSpace");
    needed |= kKnown;
    if ((location.locationFlags & needed) != needed)
        return;
    const interaction::Pose& room = session.room_from_space();
    std::optional<interaction::Velocity> moving;
    if ((velocity.velocityFlags & kMoving) == kMoving) {
        const glm::dquat turn(room.orientation);
        moving = {turn * vector_of(velocity.linearVelocity),
                  turn * vector_of(velocity.angularVelocity)};
    }
    device.add_pose(now, placed(room, pose_of(location.pose)), moving,
                    Seconds(1e-9 * static_cast<double>(time)));
}

struct Button {
    HandAction action;
    WandButton bit;
};
constexpr std::array kButtons{Button{HandAction::grab, WandButton::grab},
                              Button{HandAction::fly, WandButton::fly},
                              Button{HandAction::teleport, WandButton::teleport},
                              Button{HandAction::recenter, WandButton::recenter}};

/// Value of a stick, without its dead zone.
float stick(const OpenXrSession& session, const OpenXrActions& actions, HandAction action,
            Hand hand) {
    return interaction::past_dead_zone(actions.value(session.handle(), action, hand), kDeadZone);
}

} // namespace

std::string name_of(Hand hand) {
    return hand == Hand::wand ? "wand" : "wand2";
}

OpenXrInput::OpenXrInput()
    : head_(options_of("head")),
      hands_{interaction::TrackedDevice(options_of(name_of(Hand::wand))),
             interaction::TrackedDevice(options_of(name_of(Hand::other)))} {}

void OpenXrInput::forget() {
    const auto seen = seen_;
    *this = OpenXrInput();
    seen_ = seen;
}

void OpenXrInput::poll_head(Seconds now, const OpenXrSession& session) {
    head_.heard(now);
    add_pose(head_, now, session, session.head_space(), kTurnMeasured);
}

void OpenXrInput::poll_hand(Seconds now, const OpenXrSession& session, const OpenXrActions& actions,
                            Hand hand) {
    interaction::TrackedDevice& device = hands_[static_cast<std::size_t>(hand)];
    if (!actions.has(session.handle(), hand))
        return;
    seen_[static_cast<std::size_t>(hand)] = true;
    device.heard(now);
    add_pose(device, now, session, actions.aim(hand), kMeasured);
    std::uint64_t down = 0;
    for (const Button& button : kButtons)
        if (actions.pressed(session.handle(), button.action, hand))
            down |= bit(button.bit);
    device.set_buttons(down);
    const auto set = [&](WandValuator which, HandAction action, Hand on) {
        device.set_valuator(static_cast<std::size_t>(which), stick(session, actions, action, on));
    };
    if (hand == Hand::other)
        return;
    set(WandValuator::isovalue, HandAction::isovalue, Hand::other);
    set(WandValuator::fly, HandAction::fly_speed, Hand::wand);
    set(WandValuator::turn, HandAction::turn, Hand::wand);
    set(WandValuator::step, HandAction::step, Hand::other);
}

void OpenXrInput::poll_keys(const OpenXrSession& session, const OpenXrActions& actions) {
    const auto add = [&](bool down, Action action) {
        keys_ |= down ? bit(action) : interaction::ActionSet();
    };
    const auto pressed = [&](HandAction action) { // by either hand
        return std::ranges::any_of(
            kHands, [&](Hand hand) { return actions.pressed(session.handle(), action, hand); });
    };
    add(pressed(HandAction::play), Action::play);
    add(pressed(HandAction::reverse), Action::reverse);
    add(pressed(HandAction::panel), Action::room_panel);
    add(pressed(HandAction::next_view), Action::next_view);
    add(pressed(HandAction::pick), Action::pick);
    if (actions.has(session.handle(), Hand::wand)) // whose device has the stick
        return;
    const float step = actions.value(session.handle(), HandAction::step, Hand::other);
    add(step > kStepAt, Action::step_forward);
    add(step < -kStepAt, Action::step_back);
}

interaction::InputState OpenXrInput::poll(Seconds now, const OpenXrSession* session,
                                          const OpenXrActions* actions) {
    keys_.reset();
    for (interaction::TrackedDevice& hand : hands_) {
        hand.set_buttons(0);
        for (std::size_t i = 0; i < static_cast<std::size_t>(WandValuator::count); ++i)
            hand.set_valuator(i, 0.0f);
    }
    if (session && session->display_time()) {
        if (recentered_at_ && *session->display_time() >= *recentered_at_)
            forget();
        poll_head(now, *session);
        if (actions->sync(session->handle())) {
            for (const Hand hand : kHands)
                poll_hand(now, *session, *actions, hand);
            poll_keys(*session, *actions);
        }
    }
    interaction::InputState input{now, {head_.poll(now)}};
    for (const Hand hand : kHands)
        if (seen_[static_cast<std::size_t>(hand)])
            input.devices.push_back(hands_[static_cast<std::size_t>(hand)].poll(now));
    if (keys_.any())
        input.devices.push_back({.name = "keys", .pose = {}, .valuators = {}, .actions = keys_});
    return input;
}

std::vector<std::string> OpenXrInput::status() const {
    std::vector<std::string> lines{head_.status()};
    for (const Hand hand : kHands)
        if (seen_[static_cast<std::size_t>(hand)])
            lines.push_back(hands_[static_cast<std::size_t>(hand)].status());
    return lines;
}

} // namespace isochron::stereo
