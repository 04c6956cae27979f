// Creates OpenXR's actions, reads their states, and vibrates controllers.
#include "stereo/openxr/openxr_actions.h"

#include "stereo/openxr/openxr_error.h"
#include "stereo/openxr/openxr_poses.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <string>

namespace isochron::stereo {
namespace {

struct ActionRow {
    HandAction action;
    XrActionType type;
    const char *name, *words; ///< `words` are shown in a runtime's menu
};
constexpr std::array kRows{
    ActionRow{HandAction::aim, XR_ACTION_TYPE_POSE_INPUT, "aim", "Where a hand points"},
    ActionRow{HandAction::haptic, XR_ACTION_TYPE_VIBRATION_OUTPUT, "haptic", "Touch"},
    ActionRow{HandAction::grab, XR_ACTION_TYPE_BOOLEAN_INPUT, "grab", "Grab the volume"},
    ActionRow{HandAction::fly, XR_ACTION_TYPE_BOOLEAN_INPUT, "fly", "Fly where the hand points"},
    ActionRow{HandAction::teleport, XR_ACTION_TYPE_BOOLEAN_INPUT, "teleport", "Aim and teleport"},
    ActionRow{HandAction::recenter, XR_ACTION_TYPE_BOOLEAN_INPUT, "recenter", "Volume ahead"},
    ActionRow{HandAction::next_view, XR_ACTION_TYPE_BOOLEAN_INPUT, "next_view", "Next viewpoint"},
    ActionRow{HandAction::pick, XR_ACTION_TYPE_BOOLEAN_INPUT, "pick", "Pick the surface"},
    ActionRow{HandAction::fly_speed, XR_ACTION_TYPE_FLOAT_INPUT, "fly_speed", "Fly and back"},
    ActionRow{HandAction::turn, XR_ACTION_TYPE_FLOAT_INPUT, "turn", "Turn"},
    ActionRow{HandAction::isovalue, XR_ACTION_TYPE_FLOAT_INPUT, "isovalue", "Isovalue"},
    ActionRow{HandAction::step, XR_ACTION_TYPE_FLOAT_INPUT, "step", "Step of time"},
    ActionRow{HandAction::play, XR_ACTION_TYPE_BOOLEAN_INPUT, "play", "Play and pause"},
    ActionRow{HandAction::reverse, XR_ACTION_TYPE_BOOLEAN_INPUT, "reverse", "Reverse time"},
    ActionRow{HandAction::panel, XR_ACTION_TYPE_BOOLEAN_INPUT, "panel", "Panel in the room"},
};
static_assert(kRows.size() == static_cast<std::size_t>(HandAction::count));

std::string full_path(const char* user, std::string_view path) {
    return std::string(user) + "/" + std::string(path);
}

} // namespace

OpenXrActions::OpenXrActions(const OpenXrInstance& instance, bool left_handed)
    : left_handed_(left_handed) {
    XrActionSetCreateInfo info{XR_TYPE_ACTION_SET_CREATE_INFO};
    std::strcpy(info.actionSetName, "explore");
    std::strcpy(info.localizedActionSetName, "Explore");
    check(xrCreateActionSet(instance.handle(), &info, &set_), "xrCreateActionSet");
    try {
        for (const Hand hand : kHands)
            users_[static_cast<std::size_t>(hand)] = instance.path(user(hand));
        for (const ActionRow& row : kRows)
            make_action(instance, row.action);
        suggest(instance);
    } catch (...) {
        xrDestroyActionSet(set_);
        throw;
    }
}

OpenXrActions::~OpenXrActions() {
    xrDestroyActionSet(set_); // also destroys its actions
}

const char* OpenXrActions::user(Hand hand) const {
    return (hand == Hand::other) != left_handed_ ? "/user/hand/left" : "/user/hand/right";
}

void OpenXrActions::make_action(const OpenXrInstance&, HandAction which) {
    const ActionRow& row = *std::ranges::find(kRows, which, &ActionRow::action);
    XrActionCreateInfo info{XR_TYPE_ACTION_CREATE_INFO};
    std::strcpy(info.actionName, row.name);           // NOLINT: a name of kRows fits
    std::strcpy(info.localizedActionName, row.words); // NOLINT: a name of kRows fits
    info.actionType = row.type;
    info.countSubactionPaths = static_cast<std::uint32_t>(users_.size());
    info.subactionPaths = users_.data();
    check(xrCreateAction(set_, &info, &actions_[static_cast<std::size_t>(which)]),
          "xrCreateAction");
}

void OpenXrActions::suggest(const OpenXrInstance& instance) const {
    std::map<std::string_view, std::vector<XrActionSuggestedBinding>> profiles;
    const auto add = [&](std::string_view profile, HandAction which, Hand hand,
                         std::string_view path) {
        profiles[profile].push_back(
            {action(which), instance.path(full_path(user(hand), path).c_str())});
    };
    for (const HandBinding& each : hand_bindings())
        add(each.profile, each.action, each.hand,
            path_on(each, (each.hand == Hand::other) != left_handed_));
    for (auto& [profile, bindings] : profiles) {
        for (const Hand hand : kHands) {
            add(profile, HandAction::aim, hand, "input/aim/pose");
            add(profile, HandAction::haptic, hand, "output/haptic");
        }
        XrInteractionProfileSuggestedBinding info{XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING};
        info.interactionProfile =
            instance.path(("/interaction_profiles/" + std::string(profile)).c_str());
        info.countSuggestedBindings = static_cast<std::uint32_t>(bindings.size());
        info.suggestedBindings = bindings.data();
        check(xrSuggestInteractionProfileBindings(instance.handle(), &info),
              "xrSuggestInteractionProfileBindings");
    }
}

void OpenXrActions::attach(XrSession session) {
    XrSessionActionSetsAttachInfo info{XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO};
    info.countActionSets = 1;
    info.actionSets = &set_;
    check(xrAttachSessionActionSets(session, &info), "xrAttachSessionActionSets");
    for (const Hand hand : kHands) {
        const auto i = static_cast<std::size_t>(hand);
        XrActionSpaceCreateInfo space{XR_TYPE_ACTION_SPACE_CREATE_INFO};
        space.action = action(HandAction::aim);
        space.subactionPath = users_[i];
        space.poseInActionSpace = xr_pose({});
        check(xrCreateActionSpace(session, &space, &aims_[i]), "xrCreateActionSpace");
    }
}

bool OpenXrActions::sync(XrSession session) const {
    const XrActiveActionSet active{set_, XR_NULL_PATH};
    XrActionsSyncInfo info{XR_TYPE_ACTIONS_SYNC_INFO};
    info.countActiveActionSets = 1;
    info.activeActionSets = &active;
    return check(xrSyncActions(session, &info), "xrSyncActions") != XR_SESSION_NOT_FOCUSED;
}

XrActionStateGetInfo OpenXrActions::of(HandAction which, Hand hand) const {
    XrActionStateGetInfo info{XR_TYPE_ACTION_STATE_GET_INFO};
    info.action = action(which);
    info.subactionPath = users_[static_cast<std::size_t>(hand)];
    return info;
}

bool OpenXrActions::has(XrSession session, Hand hand) const {
    const XrActionStateGetInfo info = of(HandAction::aim, hand);
    XrActionStatePose state{XR_TYPE_ACTION_STATE_POSE};
    check(xrGetActionStatePose(session, &info, &state), "xrGetActionStatePose");
    return state.isActive;
}

bool OpenXrActions::pressed(XrSession session, HandAction which, Hand hand) const {
    const XrActionStateGetInfo info = of(which, hand);
    XrActionStateBoolean state{XR_TYPE_ACTION_STATE_BOOLEAN};
    check(xrGetActionStateBoolean(session, &info, &state), "xrGetActionStateBoolean");
    return state.isActive && state.currentState;
}

float OpenXrActions::value(XrSession session, HandAction which, Hand hand) const {
    const XrActionStateGetInfo info = of(which, hand);
    XrActionStateFloat state{XR_TYPE_ACTION_STATE_FLOAT};
    check(xrGetActionStateFloat(session, &info, &state), "xrGetActionStateFloat");
    return state.isActive ? state.currentState : 0.0f;
}

void OpenXrActions::vibrate(XrSession session, Hand hand, interaction::Seconds duration,
                            float amplitude) const {
    XrHapticActionInfo info{XR_TYPE_HAPTIC_ACTION_INFO};
    info.action = action(HandAction::haptic);
    info.subactionPath = users_[static_cast<std::size_t>(hand)];
    XrHapticVibration pulse{XR_TYPE_HAPTIC_VIBRATION};
    pulse.duration = static_cast<XrDuration>(1e9 * duration.count());
    pulse.frequency = XR_FREQUENCY_UNSPECIFIED;
    pulse.amplitude = std::clamp(amplitude, 0.0f, 1.0f);
    check(
        xrApplyHapticFeedback(session, &info, reinterpret_cast<const XrHapticBaseHeader*>(&pulse)),
        "xrApplyHapticFeedback");
}

} // namespace isochron::stereo
