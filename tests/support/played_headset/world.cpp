// State of the played runtime, its log of violations, and its events.
#include "tests/support/played_headset/world.h"

#include <nlohmann/json.hpp>

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

namespace isochron::played {

World& world() {
    static World one;
    return one;
}

PlayedHeadset& played_headset() {
    return world().headset;
}

PlayedHeadset::PlayedHeadset() {
    formats = {GL_SRGB8_ALPHA8, GL_RGBA16F, GL_RGBA8, GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT32F};
    eyes[0].in_head = {{-0.032f, 0, 0}, {1, 0, 0, 0}};
    eyes[1].in_head = {{0.032f, 0, 0}, {1, 0, 0, 0}};
    eyes[1].fov = {-0.8f, 0.9f, 0.85f, -0.95f};
}

void PlayedHeadset::happens(Happening what) {
    world().happenings.push_back(what);
}

void PlayedHeadset::reset() {
    world().happenings.clear();
    *this = PlayedHeadset();
}

XrResult refuse(const char* call, const char* code, XrResult result, const std::string& text) {
    world().headset.violations.push_back({code, call, text});
    if (!world().log.empty())
        std::ofstream(world().log, std::ios::app)
            << nlohmann::json{{"violation", code}, {"call", call}, {"text", text}}.dump() << "\n";
    return result;
}

std::string World::path(XrPath path) const {
    return path >= 1 && path <= paths.size() ? paths[path - 1] : std::string();
}

XrPath World::path_of(const std::string& text) {
    const auto found = std::ranges::find(paths, text);
    if (found != paths.end())
        return static_cast<XrPath>(found - paths.begin()) + 1;
    paths.push_back(text);
    return paths.size();
}

const Hand& World::hand(const std::string& user_path) const {
    return user_path.starts_with("/user/hand/left") ? headset.left : headset.right;
}

XrResult check_instance(XrInstance instance, const char* call) {
    if (id_of(instance) != world().instance || world().instance == 0)
        return refuse(call, "dead_handle", XR_ERROR_HANDLE_INVALID, "no such instance");
    return world().instance_lost ? XR_ERROR_INSTANCE_LOST : XR_SUCCESS;
}

XrResult check_session(XrSession session, const char* call) {
    if (!world().session || id_of(session) != world().session_handle)
        return refuse(call, "dead_handle", XR_ERROR_HANDLE_INVALID, "no such session");
    if (world().instance_lost)
        return XR_ERROR_INSTANCE_LOST;
    return world().session->lost ? XR_ERROR_SESSION_LOST : XR_SUCCESS;
}

bool has_type(const void* structure, XrStructureType expected, const char* call) {
    const auto* header = static_cast<const XrBaseInStructure*>(structure);
    if (header && header->type == expected)
        return true;
    refuse(call, "wrong_type", XR_ERROR_VALIDATION_FAILURE,
           header ? "structure type " + std::to_string(header->type) + ", expected " +
                        std::to_string(expected)
                  : std::string("no structure"));
    return false;
}

const void* in_chain(const void* first, XrStructureType type) {
    for (auto* each = static_cast<const XrBaseInStructure*>(first); each; each = each->next)
        if (each->type == type)
            return each;
    return nullptr;
}

void push_state(XrSessionState state) {
    XrEventDataBuffer buffer{};
    XrEventDataSessionStateChanged event{};
    event.type = XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED;
    event.session = reinterpret_cast<XrSession>(world().session_handle);
    event.state = state;
    event.time = std::max<std::int64_t>(world().session->display_time, 1);
    std::memcpy(&buffer, &event, sizeof event);
    world().events.push_back(buffer);
    world().session->state = state;
}

namespace {

void push_recentered() {
    XrEventDataBuffer buffer{};
    XrEventDataReferenceSpaceChangePending event{};
    event.type = XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING;
    event.session = reinterpret_cast<XrSession>(world().session_handle);
    event.referenceSpaceType =
        world().headset.has_stage ? XR_REFERENCE_SPACE_TYPE_STAGE : XR_REFERENCE_SPACE_TYPE_LOCAL;
    event.changeTime = world().session->display_time + 2 * world().headset.period;
    event.poseInPreviousSpace.orientation.w = 1;
    std::memcpy(&buffer, &event, sizeof event);
    world().events.push_back(buffer);
}

void happen(Happening what, Session& session) {
    switch (what) {
    case Happening::exit: session.exit_asked = true; break;
    case Happening::hide: session.hidden = session.covered = true; break;
    case Happening::cover: session.hidden = false, session.covered = true; break;
    case Happening::show: session.hidden = session.covered = false; break;
    case Happening::recenter: push_recentered(); break;
    case Happening::lose_session: push_state(XR_SESSION_STATE_LOSS_PENDING); break;
    case Happening::lose_at_once: session.lost = true; break;
    case Happening::lose_instance: world().instance_lost = true; break;
    }
}

/// The next state on the session's way to its final one.
XrSessionState next_state(const Session& session) {
    const auto state = session.state;
    const bool leaving = session.exit_asked || session.hidden;
    if (state == XR_SESSION_STATE_FOCUSED && (leaving || session.covered))
        return XR_SESSION_STATE_VISIBLE;
    if (state == XR_SESSION_STATE_VISIBLE && leaving)
        return XR_SESSION_STATE_SYNCHRONIZED;
    if (state == XR_SESSION_STATE_SYNCHRONIZED && session.exit_asked)
        return XR_SESSION_STATE_STOPPING;
    if (state == XR_SESSION_STATE_SYNCHRONIZED && !leaving)
        return XR_SESSION_STATE_VISIBLE;
    if (state == XR_SESSION_STATE_VISIBLE && !leaving && !session.covered)
        return XR_SESSION_STATE_FOCUSED;
    return state;
}

} // namespace

void happen() {
    World& here = world();
    if (!here.session)
        return;
    for (const Happening what : std::exchange(here.happenings, {}))
        happen(what, *here.session);
    if (!here.session->begun || here.session->state == XR_SESSION_STATE_LOSS_PENDING)
        return;
    const XrSessionState next = next_state(*here.session);
    if (next != here.session->state)
        push_state(next);
}

interaction::Pose from_xr(const XrPosef& pose) {
    return {
        {pose.position.x, pose.position.y, pose.position.z},
        glm::quat(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z)};
}

XrPosef to_xr(const interaction::Pose& pose) {
    return {{pose.orientation.x, pose.orientation.y, pose.orientation.z, pose.orientation.w},
            {pose.position.x, pose.position.y, pose.position.z}};
}

bool is_unit(const XrPosef& pose) {
    constexpr float kSlack = 0.01f; // the specification allows 1 %
    return std::abs(glm::length(from_xr(pose).orientation) - 1.0f) <= kSlack;
}

interaction::Pose compose(const interaction::Pose& parent, const interaction::Pose& child) {
    return {parent.position + parent.orientation * child.position,
            parent.orientation * child.orientation};
}

interaction::Pose seen_from(const interaction::Pose& b, const interaction::Pose& a) {
    const glm::quat back = glm::conjugate(b.orientation);
    return {back * (a.position - b.position), back * a.orientation};
}

} // namespace isochron::played
