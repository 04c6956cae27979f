// The state of the played runtime between calls, and the checks of calls.
#pragma once

#include "stereo/openxr/openxr_platform.h"

#include "render/gl/gl.h"
#include "tests/support/played_headset/played_headset.h"

#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace isochron::played {

struct ActionSet {
    std::string name;
    bool attached = false, synced = false;
};
struct Action {
    std::uint64_t set = 0;
    std::string name;
    XrActionType type{};
    std::set<XrPath> subactions;
    std::map<XrPath, float> before; ///< by subaction path: the value at the last sync
};
struct Binding {
    std::uint64_t action;
    std::string path; ///< `/user/hand/left/input/x/click`
};
struct Space {
    std::optional<std::uint64_t> action; ///< empty: a reference space
    XrPath subaction = XR_NULL_PATH;
    XrReferenceSpaceType type{};
    interaction::Pose offset;
};
struct Swapchain {
    XrSwapchainCreateInfo info{};
    std::vector<GLuint> textures;
    std::deque<std::uint32_t> acquired; ///< oldest first
    bool waited = false;                ///< for the oldest
    std::optional<std::uint32_t> released;
    std::uint32_t next = 0;
};
enum class FrameStage : std::uint8_t { idle, waited, begun };
struct Session {
    XrSessionState state = XR_SESSION_STATE_UNKNOWN; ///< as of the last event
    bool begun = false, attached = false, lost = false, exit_asked = false, stopping = false;
    bool hidden = false, covered = false;
    FrameStage frame = FrameStage::idle;
    std::int64_t display_time = 0;                   ///< display time of the newest frame
    bool views_located = false, views_valid = false; ///< for that frame
    std::array<interaction::Pose, 2> located;        ///< in the stage
    std::array<interaction::Pose, 2> filled;         ///< `located` when the images were last filled
    std::unique_ptr<render::Gl> gl;
    void* context = nullptr; ///< GL context with which it was made
    void* (*current_context)() = nullptr;
};

struct World {
    PlayedHeadset headset;
    std::vector<std::string> paths; ///< XrPath i is paths[i - 1]
    std::uint64_t handles = 0;      ///< number of handles so far
    std::uint64_t instance = 0, session_handle = 0;
    bool instance_lost = false, requirements_asked = false, system_asked = false;
    std::set<std::string> extensions; ///< enabled
    std::unique_ptr<Session> session;
    std::map<std::uint64_t, ActionSet> sets;
    std::map<std::uint64_t, Action> actions;
    std::map<std::uint64_t, Space> spaces;
    std::map<std::uint64_t, Swapchain> swapchains;
    std::map<std::string, std::vector<Binding>> suggestions; ///< by profile
    std::deque<XrEventDataBuffer> events;
    std::vector<Happening> happenings; ///< still to come
    std::filesystem::path log, pictures;

    std::string path(XrPath path) const;
    XrPath path_of(const std::string& text);
    const Hand& hand(const std::string& user_path) const;
};
World& world();

/// Notes a violation. @return `result`
XrResult refuse(const char* call, const char* code, XrResult result, const std::string& text);

template <typename Handle>
std::uint64_t id_of(Handle handle) {
    return reinterpret_cast<std::uint64_t>(handle);
}
template <typename Handle>
Handle new_handle() {
    return reinterpret_cast<Handle>(++world().handles);
}

/// XR_SUCCESS if calls on the instance, or on the session, are allowed; else the error.
XrResult check_instance(XrInstance instance, const char* call);
XrResult check_session(XrSession session, const char* call);
/// @return whether a structure has the expected type; else notes a violation
bool has_type(const void* structure, XrStructureType expected, const char* call);
/// The member of a chain with this type; null if there is none.
const void* in_chain(const void* first, XrStructureType type);

/// Fills a list as in OpenXR's functions that are called twice.
template <typename T, typename Fill>
XrResult fill(std::size_t size, std::uint32_t capacity, std::uint32_t* count, T* items, Fill set) {
    *count = static_cast<std::uint32_t>(size);
    if (capacity == 0)
        return XR_SUCCESS;
    if (capacity < size)
        return XR_ERROR_SIZE_INSUFFICIENT;
    for (std::size_t i = 0; i < size; ++i)
        set(items[i], i);
    return XR_SUCCESS;
}

void push_state(XrSessionState state);
/// Makes the happenings that are due happen; called by calls in which a runtime does its work.
void happen();

interaction::Pose from_xr(const XrPosef& pose);
XrPosef to_xr(const interaction::Pose& pose);
bool is_unit(const XrPosef& pose);
/// The pose `a` relative to `b`; both are in the stage.
interaction::Pose seen_from(const interaction::Pose& b, const interaction::Pose& a);
interaction::Pose compose(const interaction::Pose& parent, const interaction::Pose& child);

/// Where a space is in the stage.
struct Located {
    interaction::Pose pose;
    interaction::Velocity velocity;
    bool tracked = true;
};
std::optional<Located> locate(const Space& space);

/// The bindings of an action in the current profile, for one hand or for any.
std::vector<std::string> bound_paths(const Action& action, std::uint64_t handle, XrPath subaction);

/// Reads the script, once, in a separate program.
void read_script();
/// Applies the script to the frame that begins.
void play_script(std::size_t frame);

// The entry points, by file; negotiate.cpp hands them out.
using Entry = PFN_xrVoidFunction;
struct NamedEntry {
    const char* name;
    Entry entry;
};
std::vector<NamedEntry> instance_entries();
std::vector<NamedEntry> session_entries();
std::vector<NamedEntry> frame_entries();
std::vector<NamedEntry> swapchain_entries();
std::vector<NamedEntry> space_entries();
std::vector<NamedEntry> action_entries();
template <typename Function>
NamedEntry named(const char* name, Function function) {
    return {name, reinterpret_cast<Entry>(function)};
}

} // namespace isochron::played
