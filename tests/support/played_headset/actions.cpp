// The played runtime's actions: sets, bindings, states and haptics.
#include "tests/support/played_headset/profiles.h"
#include "tests/support/played_headset/world.h"

#include <algorithm>
#include <cmath>

namespace isochron::played {
namespace {

constexpr float kPressed = 0.5f; ///< a value that counts as a press

XrResult XRAPI_CALL create_set(XrInstance instance, const XrActionSetCreateInfo* info,
                               XrActionSet* out) {
    constexpr const char* kCall = "xrCreateActionSet";
    if (const XrResult bad = check_instance(instance, kCall); bad)
        return bad;
    has_type(info, XR_TYPE_ACTION_SET_CREATE_INFO, kCall);
    if (!info->actionSetName[0] || !info->localizedActionSetName[0])
        return refuse(kCall, "no_name", XR_ERROR_NAME_INVALID, "of the set");
    for (const auto& [id, set] : world().sets)
        if (set.name == info->actionSetName)
            return refuse(kCall, "name_taken", XR_ERROR_NAME_DUPLICATED, set.name);
    *out = new_handle<XrActionSet>();
    world().sets[id_of(*out)].name = info->actionSetName;
    return XR_SUCCESS;
}

XrResult XRAPI_CALL destroy_set(XrActionSet set) {
    if (world().sets.erase(id_of(set)) == 0)
        return refuse("xrDestroyActionSet", "dead_handle", XR_ERROR_HANDLE_INVALID, "no such set");
    std::erase_if(world().actions, [&](const auto& each) { return each.second.set == id_of(set); });
    return XR_SUCCESS;
}

XrResult XRAPI_CALL create_action(XrActionSet set, const XrActionCreateInfo* info, XrAction* out) {
    constexpr const char* kCall = "xrCreateAction";
    const auto at = world().sets.find(id_of(set));
    if (at == world().sets.end())
        return refuse(kCall, "dead_handle", XR_ERROR_HANDLE_INVALID, "no such set");
    has_type(info, XR_TYPE_ACTION_CREATE_INFO, kCall);
    if (at->second.attached)
        return refuse(kCall, "set_attached", XR_ERROR_ACTIONSETS_ALREADY_ATTACHED, at->second.name);
    if (!info->actionName[0] || !info->localizedActionName[0])
        return refuse(kCall, "no_name", XR_ERROR_NAME_INVALID, "of the action");
    Action action{id_of(set), info->actionName, info->actionType, {}, {}};
    for (std::uint32_t i = 0; i < info->countSubactionPaths; ++i)
        action.subactions.insert(info->subactionPaths[i]);
    *out = new_handle<XrAction>();
    world().actions.emplace(id_of(*out), std::move(action));
    return XR_SUCCESS;
}

XrResult XRAPI_CALL destroy_action(XrAction action) {
    if (world().actions.erase(id_of(action)) == 0)
        return refuse("xrDestroyAction", "dead_handle", XR_ERROR_HANDLE_INVALID, "no such action");
    return XR_SUCCESS;
}

XrResult XRAPI_CALL suggest(XrInstance instance, const XrInteractionProfileSuggestedBinding* info) {
    constexpr const char* kCall = "xrSuggestInteractionProfileBindings";
    if (const XrResult bad = check_instance(instance, kCall); bad)
        return bad;
    has_type(info, XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING, kCall);
    World& here = world();
    const std::string profile = here.path(info->interactionProfile);
    if (!is_profile(profile))
        return refuse(kCall, "bad_profile", XR_ERROR_PATH_UNSUPPORTED, profile);
    std::vector<Binding> bindings;
    for (std::uint32_t i = 0; i < info->countSuggestedBindings; ++i) {
        const XrActionSuggestedBinding& one = info->suggestedBindings[i];
        const auto action = here.actions.find(id_of(one.action));
        if (action == here.actions.end())
            return refuse(kCall, "dead_handle", XR_ERROR_HANDLE_INVALID, "no such action");
        if (here.sets.at(action->second.set).attached)
            return refuse(kCall, "suggested_late", XR_ERROR_ACTIONSETS_ALREADY_ATTACHED,
                          action->second.name);
        const std::string path = here.path(one.binding);
        if (!has_path(profile, path))
            return refuse(kCall, "path_not_of_profile", XR_ERROR_PATH_UNSUPPORTED,
                          profile + " has no " + path);
        bindings.push_back({action->first, path});
        here.headset.suggested.push_back(profile + " " + action->second.name + " " + path);
    }
    here.suggestions[profile] = std::move(bindings);
    return XR_SUCCESS;
}

XrResult XRAPI_CALL attach(XrSession session, const XrSessionActionSetsAttachInfo* info) {
    constexpr const char* kCall = "xrAttachSessionActionSets";
    if (const XrResult bad = check_session(session, kCall); bad)
        return bad;
    has_type(info, XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO, kCall);
    if (world().session->attached)
        return refuse(kCall, "attached_twice", XR_ERROR_ACTIONSETS_ALREADY_ATTACHED,
                      "this session has its sets");
    for (std::uint32_t i = 0; i < info->countActionSets; ++i) {
        const auto at = world().sets.find(id_of(info->actionSets[i]));
        if (at == world().sets.end())
            return refuse(kCall, "dead_handle", XR_ERROR_HANDLE_INVALID, "no such set");
        at->second.attached = true;
        at->second.synced = false;
    }
    world().session->attached = true;
    return XR_SUCCESS;
}

float value_of(const Action& action, std::uint64_t id, XrPath subaction) {
    float value = 0;
    for (const std::string& path : bound_paths(action, id, subaction)) {
        const Hand& hand = world().hand(path);
        const auto input = path.find("/input/");
        if (!hand.present || input == std::string::npos)
            continue;
        const auto at = hand.inputs.find(path.substr(input + std::string("/input/").size()));
        if (at != hand.inputs.end() && std::abs(at->second) > std::abs(value))
            value = at->second;
    }
    return value;
}

XrResult XRAPI_CALL sync(XrSession session, const XrActionsSyncInfo* info) {
    constexpr const char* kCall = "xrSyncActions";
    if (const XrResult bad = check_session(session, kCall); bad)
        return bad;
    has_type(info, XR_TYPE_ACTIONS_SYNC_INFO, kCall);
    for (std::uint32_t i = 0; i < info->countActiveActionSets; ++i) {
        const auto at = world().sets.find(id_of(info->activeActionSets[i].actionSet));
        if (at == world().sets.end() || !at->second.attached || !world().session->attached)
            return refuse(kCall, "set_not_attached", XR_ERROR_ACTIONSET_NOT_ATTACHED,
                          "a set that this session does not have");
        at->second.synced = true;
    }
    return world().session->state == XR_SESSION_STATE_FOCUSED ? XR_SUCCESS : XR_SESSION_NOT_FOCUSED;
}

XrResult check_action(XrSession session, const XrActionStateGetInfo* info, XrActionType type,
                      const char* call, Action*& found) {
    if (const XrResult bad = check_session(session, call); bad)
        return bad;
    has_type(info, XR_TYPE_ACTION_STATE_GET_INFO, call);
    const auto at = world().actions.find(id_of(info->action));
    if (at == world().actions.end())
        return refuse(call, "dead_handle", XR_ERROR_HANDLE_INVALID, "no such action");
    const ActionSet& set = world().sets.at(at->second.set);
    if (!set.attached)
        return refuse(call, "set_not_attached", XR_ERROR_ACTIONSET_NOT_ATTACHED, set.name);
    if (!set.synced)
        refuse(call, "state_before_sync", XR_SUCCESS, at->second.name);
    if (at->second.type != type)
        return refuse(call, "wrong_action_type", XR_ERROR_ACTION_TYPE_MISMATCH, at->second.name);
    if (info->subactionPath && !at->second.subactions.contains(info->subactionPath))
        return refuse(call, "path_not_declared", XR_ERROR_PATH_UNSUPPORTED,
                      world().path(info->subactionPath));
    found = &at->second;
    return XR_SUCCESS;
}

bool is_active(const Action& action, std::uint64_t id, XrPath subaction) {
    const auto paths = bound_paths(action, id, subaction);
    return world().session->state == XR_SESSION_STATE_FOCUSED &&
           std::any_of(paths.begin(), paths.end(),
                       [](const std::string& path) { return world().hand(path).present; });
}

/// The code that states of booleans and of floats share.
template <typename State, typename Value>
XrResult get_state(XrSession session, const XrActionStateGetInfo* info, State* out,
                   XrStructureType structure, XrActionType type, const char* call, Value value) {
    Action* action = nullptr;
    if (const XrResult bad = check_action(session, info, type, call, action); bad)
        return bad;
    has_type(out, structure, call);
    const bool active = is_active(*action, id_of(info->action), info->subactionPath);
    const float now = active ? value_of(*action, id_of(info->action), info->subactionPath) : 0.0f;
    float& before = action->before[info->subactionPath];
    out->isActive = active;
    out->currentState = value(now);
    out->changedSinceLastSync = value(now) != value(before);
    out->lastChangeTime = active ? world().session->display_time : 0;
    before = now;
    return XR_SUCCESS;
}

XrResult XRAPI_CALL get_boolean(XrSession session, const XrActionStateGetInfo* info,
                                XrActionStateBoolean* out) {
    return get_state(session, info, out, XR_TYPE_ACTION_STATE_BOOLEAN, XR_ACTION_TYPE_BOOLEAN_INPUT,
                     "xrGetActionStateBoolean",
                     [](float value) { return XrBool32(value > kPressed); });
}

XrResult XRAPI_CALL get_float(XrSession session, const XrActionStateGetInfo* info,
                              XrActionStateFloat* out) {
    return get_state(session, info, out, XR_TYPE_ACTION_STATE_FLOAT, XR_ACTION_TYPE_FLOAT_INPUT,
                     "xrGetActionStateFloat", [](float value) { return value; });
}

XrResult XRAPI_CALL get_pose(XrSession session, const XrActionStateGetInfo* info,
                             XrActionStatePose* out) {
    constexpr const char* kCall = "xrGetActionStatePose";
    Action* action = nullptr;
    if (const XrResult bad = check_action(session, info, XR_ACTION_TYPE_POSE_INPUT, kCall, action);
        bad)
        return bad;
    has_type(out, XR_TYPE_ACTION_STATE_POSE, kCall);
    out->isActive = is_active(*action, id_of(info->action), info->subactionPath);
    return XR_SUCCESS;
}

XrResult XRAPI_CALL current_profile(XrSession session, XrPath user,
                                    XrInteractionProfileState* out) {
    constexpr const char* kCall = "xrGetCurrentInteractionProfile";
    if (const XrResult bad = check_session(session, kCall); bad)
        return bad;
    has_type(out, XR_TYPE_INTERACTION_PROFILE_STATE, kCall);
    if (!world().session->attached)
        return refuse(kCall, "set_not_attached", XR_ERROR_ACTIONSET_NOT_ATTACHED, "no set");
    World& here = world();
    const bool present = here.hand(here.path(user)).present;
    out->interactionProfile = present && here.suggestions.contains(here.headset.profile)
                                  ? here.path_of(here.headset.profile)
                                  : XR_NULL_PATH;
    return XR_SUCCESS;
}

XrResult XRAPI_CALL apply_haptic(XrSession session, const XrHapticActionInfo* info,
                                 const XrHapticBaseHeader* feedback) {
    constexpr const char* kCall = "xrApplyHapticFeedback";
    if (const XrResult bad = check_session(session, kCall); bad)
        return bad;
    has_type(info, XR_TYPE_HAPTIC_ACTION_INFO, kCall);
    const auto at = world().actions.find(id_of(info->action));
    if (at == world().actions.end())
        return refuse(kCall, "dead_handle", XR_ERROR_HANDLE_INVALID, "no such action");
    if (at->second.type != XR_ACTION_TYPE_VIBRATION_OUTPUT)
        return refuse(kCall, "wrong_action_type", XR_ERROR_ACTION_TYPE_MISMATCH, at->second.name);
    if (!has_type(feedback, XR_TYPE_HAPTIC_VIBRATION, kCall))
        return XR_ERROR_VALIDATION_FAILURE;
    const auto& pulse = *reinterpret_cast<const XrHapticVibration*>(feedback);
    if (!(pulse.amplitude >= 0 && pulse.amplitude <= 1))
        return refuse(kCall, "bad_amplitude", XR_ERROR_VALIDATION_FAILURE, "0 to 1 is expected");
    if (is_active(at->second, at->first, info->subactionPath))
        world().headset.pulses.push_back(
            {world().path(info->subactionPath), pulse.duration, pulse.amplitude});
    return XR_SUCCESS;
}

} // namespace

std::vector<std::string> bound_paths(const Action&, std::uint64_t handle, XrPath subaction) {
    const std::string hand = world().path(subaction);
    std::vector<std::string> paths;
    for (const Binding& binding : world().suggestions[world().headset.profile])
        if (binding.action == handle && (hand.empty() || binding.path.starts_with(hand + "/")))
            paths.push_back(binding.path);
    return paths;
}

std::vector<NamedEntry> action_entries() {
    return {named("xrCreateActionSet", create_set),
            named("xrDestroyActionSet", destroy_set),
            named("xrCreateAction", create_action),
            named("xrDestroyAction", destroy_action),
            named("xrSuggestInteractionProfileBindings", suggest),
            named("xrAttachSessionActionSets", attach),
            named("xrSyncActions", sync),
            named("xrGetActionStateBoolean", get_boolean),
            named("xrGetActionStateFloat", get_float),
            named("xrGetActionStatePose", get_pose),
            named("xrGetCurrentInteractionProfile", current_profile),
            named("xrApplyHapticFeedback", apply_haptic)};
}

} // namespace isochron::played
