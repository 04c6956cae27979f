// The played runtime's spaces: where the head, the hands and the eyes are.
#include "tests/support/played_headset/world.h"

namespace isochron::played {
namespace {

constexpr XrSpaceLocationFlags kValid =
    XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT;
constexpr XrSpaceLocationFlags kTracked =
    XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT | XR_SPACE_LOCATION_POSITION_TRACKED_BIT;

XrVector3f vector(const glm::dvec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

std::vector<XrReferenceSpaceType> reference_spaces() {
    std::vector types{XR_REFERENCE_SPACE_TYPE_VIEW, XR_REFERENCE_SPACE_TYPE_LOCAL};
    if (world().headset.has_stage)
        types.push_back(XR_REFERENCE_SPACE_TYPE_STAGE);
    return types;
}

XrResult XRAPI_CALL enumerate_spaces(XrSession session, std::uint32_t capacity,
                                     std::uint32_t* count, XrReferenceSpaceType* out) {
    if (const XrResult bad = check_session(session, "xrEnumerateReferenceSpaces"); bad)
        return bad;
    const auto types = reference_spaces();
    return fill(types.size(), capacity, count, out,
                [&](XrReferenceSpaceType& to, std::size_t i) { to = types[i]; });
}

XrResult add(const char* call, const XrPosef& pose, Space space, XrSpace* out) {
    if (!is_unit(pose))
        return refuse(call, "pose_not_unit", XR_ERROR_POSE_INVALID, "of the space");
    space.offset = from_xr(pose);
    *out = new_handle<XrSpace>();
    world().spaces.emplace(id_of(*out), space);
    return XR_SUCCESS;
}

XrResult XRAPI_CALL create_reference_space(XrSession session,
                                           const XrReferenceSpaceCreateInfo* info, XrSpace* out) {
    constexpr const char* kCall = "xrCreateReferenceSpace";
    if (const XrResult bad = check_session(session, kCall); bad)
        return bad;
    has_type(info, XR_TYPE_REFERENCE_SPACE_CREATE_INFO, kCall);
    const auto types = reference_spaces();
    if (std::find(types.begin(), types.end(), info->referenceSpaceType) == types.end())
        return refuse(kCall, "space_not_offered", XR_ERROR_REFERENCE_SPACE_UNSUPPORTED,
                      std::to_string(info->referenceSpaceType));
    Space space;
    space.type = info->referenceSpaceType;
    return add(kCall, info->poseInReferenceSpace, space, out);
}

XrResult XRAPI_CALL create_action_space(XrSession session, const XrActionSpaceCreateInfo* info,
                                        XrSpace* out) {
    constexpr const char* kCall = "xrCreateActionSpace";
    if (const XrResult bad = check_session(session, kCall); bad)
        return bad;
    has_type(info, XR_TYPE_ACTION_SPACE_CREATE_INFO, kCall);
    const auto action = world().actions.find(id_of(info->action));
    if (action == world().actions.end())
        return refuse(kCall, "dead_handle", XR_ERROR_HANDLE_INVALID, "no such action");
    if (action->second.type != XR_ACTION_TYPE_POSE_INPUT)
        return refuse(kCall, "wrong_action_type", XR_ERROR_ACTION_TYPE_MISMATCH, "");
    if (info->subactionPath && !action->second.subactions.contains(info->subactionPath))
        return refuse(kCall, "path_not_declared", XR_ERROR_PATH_UNSUPPORTED,
                      world().path(info->subactionPath));
    Space space;
    space.action = action->first;
    space.subaction = info->subactionPath;
    return add(kCall, info->poseInActionSpace, space, out);
}

XrResult XRAPI_CALL destroy_space(XrSpace space) {
    if (world().spaces.erase(id_of(space)) == 0)
        return refuse("xrDestroySpace", "dead_handle", XR_ERROR_HANDLE_INVALID, "no such space");
    return XR_SUCCESS;
}

const Space* find(XrSpace space, const char* call) {
    const auto at = world().spaces.find(id_of(space));
    if (at != world().spaces.end())
        return &at->second;
    refuse(call, "dead_handle", XR_ERROR_HANDLE_INVALID, "no such space");
    return nullptr;
}

/// Checks that a time is the one that the client knows: that of the frame it draws.
XrResult check_time(XrTime time, const char* call) {
    if (time <= 0)
        return refuse(call, "bad_time", XR_ERROR_TIME_INVALID, std::to_string(time));
    const Session& session = *world().session;
    if (session.display_time != 0 && time != session.display_time)
        refuse(call, "other_time", XR_SUCCESS, "not the predicted display time");
    return XR_SUCCESS;
}

XrResult XRAPI_CALL locate_space(XrSpace space, XrSpace base, XrTime time, XrSpaceLocation* out) {
    constexpr const char* kCall = "xrLocateSpace";
    if (const XrResult bad =
            check_session(reinterpret_cast<XrSession>(world().session_handle), kCall);
        bad)
        return bad;
    has_type(out, XR_TYPE_SPACE_LOCATION, kCall);
    const Space* const what = find(space, kCall);
    const Space* const from = find(base, kCall);
    if (!what || !from)
        return XR_ERROR_HANDLE_INVALID;
    if (const XrResult bad = check_time(time, kCall); bad)
        return bad;
    auto* velocity = reinterpret_cast<XrSpaceVelocity*>(
        const_cast<void*>(in_chain(out->next, XR_TYPE_SPACE_VELOCITY)));
    out->locationFlags = 0;
    if (velocity)
        velocity->velocityFlags = 0;
    const auto located = locate(*what), origin = locate(*from);
    if (!located || !origin)
        return XR_SUCCESS;
    out->locationFlags = kValid | (located->tracked ? kTracked : 0);
    out->pose = to_xr(seen_from(origin->pose, located->pose));
    if (velocity) {
        const glm::dquat back(glm::conjugate(origin->pose.orientation));
        velocity->velocityFlags =
            XR_SPACE_VELOCITY_LINEAR_VALID_BIT | XR_SPACE_VELOCITY_ANGULAR_VALID_BIT;
        velocity->linearVelocity = vector(back * located->velocity.linear);
        velocity->angularVelocity = vector(back * located->velocity.angular);
    }
    return XR_SUCCESS;
}

XrResult XRAPI_CALL locate_views(XrSession session, const XrViewLocateInfo* info,
                                 XrViewState* state, std::uint32_t capacity, std::uint32_t* count,
                                 XrView* out) {
    constexpr const char* kCall = "xrLocateViews";
    if (const XrResult bad = check_session(session, kCall); bad)
        return bad;
    has_type(info, XR_TYPE_VIEW_LOCATE_INFO, kCall);
    has_type(state, XR_TYPE_VIEW_STATE, kCall);
    if (info->viewConfigurationType != XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO)
        return refuse(kCall, "bad_views", XR_ERROR_VALIDATION_FAILURE, "view configuration");
    if (const XrResult bad = check_time(info->displayTime, kCall); bad)
        return bad;
    const Space* const base = find(info->space, kCall);
    if (!base)
        return XR_ERROR_HANDLE_INVALID;
    const PlayedHeadset& headset = world().headset;
    Session& mine = *world().session;
    const auto origin = locate(*base);
    mine.views_valid = headset.head_valid && origin;
    state->viewStateFlags = mine.views_valid ? kValid : 0;
    if (mine.views_valid && headset.head_tracked)
        state->viewStateFlags |= kTracked;
    if (capacity >= 2)
        mine.views_located = true;
    return fill(2, capacity, count, out, [&](XrView& to, std::size_t i) {
        has_type(&to, XR_TYPE_VIEW, kCall);
        const Eye& eye = headset.eyes[i];
        mine.located[i] = compose(headset.head, eye.in_head);
        to.pose = to_xr(origin ? seen_from(origin->pose, mine.located[i]) : interaction::Pose{});
        to.fov = {eye.fov.left, eye.fov.right, eye.fov.up, eye.fov.down};
    });
}

XrResult XRAPI_CALL bounds(XrSession session, XrReferenceSpaceType, XrExtent2Df* out) {
    if (const XrResult bad = check_session(session, "xrGetReferenceSpaceBoundsRect"); bad)
        return bad;
    *out = {0, 0};
    return XR_SPACE_BOUNDS_UNAVAILABLE;
}

} // namespace

std::optional<Located> locate(const Space& space) {
    const PlayedHeadset& headset = world().headset;
    if (space.action) {
        const Action& action = world().actions.at(*space.action);
        const auto paths = bound_paths(action, *space.action, space.subaction);
        if (paths.empty() || world().session->state != XR_SESSION_STATE_FOCUSED)
            return std::nullopt;
        const Hand& hand = world().hand(paths.front());
        if (!hand.present)
            return std::nullopt;
        const bool aim = paths.front().ends_with("/aim/pose");
        return Located{compose(aim ? hand.aim : hand.grip, space.offset), hand.velocity,
                       hand.tracked};
    }
    if (space.type == XR_REFERENCE_SPACE_TYPE_VIEW) {
        if (!headset.head_valid)
            return std::nullopt;
        return Located{compose(headset.head, space.offset), headset.head_velocity,
                       headset.head_tracked};
    }
    const interaction::Pose origin =
        space.type == XR_REFERENCE_SPACE_TYPE_LOCAL ? headset.local_in_stage : interaction::Pose{};
    return Located{compose(origin, space.offset), {}, true};
}

std::vector<NamedEntry> space_entries() {
    return {named("xrEnumerateReferenceSpaces", enumerate_spaces),
            named("xrCreateReferenceSpace", create_reference_space),
            named("xrGetReferenceSpaceBoundsRect", bounds),
            named("xrCreateActionSpace", create_action_space),
            named("xrDestroySpace", destroy_space),
            named("xrLocateSpace", locate_space),
            named("xrLocateViews", locate_views)};
}

} // namespace isochron::played
