// The played runtime's session: its graphics binding and its life.
#include "stereo/openxr/openxr_platform.h"

#include "tests/support/played_headset/world.h"

#include <dlfcn.h>

namespace isochron::played {
namespace {

constexpr const char* kCreate = "xrCreateSession";

struct Binding {
    void* context;
    void* (*current)();
    render::GlLoader loader;
};

void* symbol(const char* library, const char* name) {
    void* handle = dlopen(library, RTLD_NOW | RTLD_LOCAL);
    return handle ? dlsym(handle, name) : nullptr;
}

std::optional<Binding> egl_binding(const void* next) {
    const auto* egl = static_cast<const XrGraphicsBindingEGLMNDX*>(
        in_chain(next, XR_TYPE_GRAPHICS_BINDING_EGL_MNDX));
    if (!egl)
        return std::nullopt;
    if (!world().extensions.contains("XR_MNDX_egl_enable") || !egl->getProcAddress ||
        !egl->display || !egl->context) {
        refuse(kCreate, "bad_binding", XR_ERROR_GRAPHICS_DEVICE_INVALID, "of EGL");
        return std::nullopt;
    }
    static decltype(&eglGetCurrentContext) current;
    current = reinterpret_cast<decltype(current)>(egl->getProcAddress("eglGetCurrentContext"));
    return Binding{egl->context, [] { return static_cast<void*>(current()); },
                   [get = egl->getProcAddress](const char* name) {
                       return reinterpret_cast<void*>(get(name));
                   }};
}

std::optional<Binding> glx_binding(const void* next) {
    const auto* glx = static_cast<const XrGraphicsBindingOpenGLXlibKHR*>(
        in_chain(next, XR_TYPE_GRAPHICS_BINDING_OPENGL_XLIB_KHR));
    if (!glx)
        return std::nullopt;
    if (!world().extensions.contains(XR_KHR_OPENGL_ENABLE_EXTENSION_NAME) || !glx->xDisplay ||
        !glx->visualid || !glx->glxFBConfig || !glx->glxDrawable || !glx->glxContext) {
        refuse(kCreate, "bad_binding", XR_ERROR_GRAPHICS_DEVICE_INVALID, "of GLX");
        return std::nullopt;
    }
    static GLXContext (*current)();
    current = reinterpret_cast<decltype(current)>(symbol("libGL.so.1", "glXGetCurrentContext"));
    const auto get =
        reinterpret_cast<void* (*)(const char*)>(symbol("libGL.so.1", "glXGetProcAddressARB"));
    return Binding{glx->glxContext, [] { return static_cast<void*>(current()); },
                   [get](const char* name) { return get(name); }};
}

XrResult XRAPI_CALL create_session(XrInstance instance, const XrSessionCreateInfo* info,
                                   XrSession* out) {
    if (const XrResult bad = check_instance(instance, kCreate); bad)
        return bad;
    World& here = world();
    if (!has_type(info, XR_TYPE_SESSION_CREATE_INFO, kCreate))
        return XR_ERROR_VALIDATION_FAILURE;
    if (here.session)
        return refuse(kCreate, "second_session", XR_ERROR_LIMIT_REACHED, "one lives already");
    if (!here.system_asked)
        return refuse(kCreate, "no_system", XR_ERROR_SYSTEM_INVALID, "xrGetSystem was not called");
    if (!here.requirements_asked)
        return refuse(kCreate, "requirements_not_asked",
                      XR_ERROR_GRAPHICS_REQUIREMENTS_CALL_MISSING,
                      "xrGetOpenGLGraphicsRequirementsKHR was not called");
    auto binding = egl_binding(info->next);
    if (!binding)
        binding = glx_binding(info->next);
    if (!binding)
        return refuse(kCreate, "bad_binding", XR_ERROR_GRAPHICS_DEVICE_INVALID, "no binding");
    if (binding->current() != binding->context)
        return refuse(kCreate, "context_not_current", XR_ERROR_GRAPHICS_DEVICE_INVALID,
                      "the binding's context is not current");
    *out = new_handle<XrSession>();
    here.session_handle = id_of(*out);
    here.session = std::make_unique<Session>();
    here.session->gl = std::make_unique<render::Gl>(binding->loader);
    here.session->context = binding->context;
    here.session->current_context = binding->current;
    ++here.headset.sessions;
    push_state(XR_SESSION_STATE_IDLE);
    push_state(XR_SESSION_STATE_READY);
    return XR_SUCCESS;
}

XrResult XRAPI_CALL destroy_session(XrSession session) {
    constexpr const char* kCall = "xrDestroySession";
    World& here = world();
    if (!here.session || id_of(session) != here.session_handle)
        return refuse(kCall, "dead_handle", XR_ERROR_HANDLE_INVALID, "no such session");
    const bool gone = here.session->lost || here.instance_lost ||
                      here.session->state == XR_SESSION_STATE_LOSS_PENDING;
    if (here.session->begun && !gone)
        refuse(kCall, "destroyed_while_running", XR_SUCCESS, "xrEndSession was not called");
    if (!here.swapchains.empty() && !gone)
        refuse(kCall, "child_alive", XR_SUCCESS,
               std::to_string(here.swapchains.size()) + " swapchains live");
    here.session.reset();
    here.swapchains.clear();
    here.spaces.clear();
    here.events.clear();
    // Action sets stay attached forever: no other session accepts them.
    return XR_SUCCESS;
}

XrResult XRAPI_CALL begin_session(XrSession session, const XrSessionBeginInfo* info) {
    constexpr const char* kCall = "xrBeginSession";
    if (const XrResult bad = check_session(session, kCall); bad)
        return bad;
    has_type(info, XR_TYPE_SESSION_BEGIN_INFO, kCall);
    Session& mine = *world().session;
    // Only events that the client has received count, not those in its queue.
    bool told = true;
    for (const XrEventDataBuffer& event : world().events)
        told = told && event.type != XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED;
    if (mine.begun)
        return refuse(kCall, "begun_twice", XR_ERROR_SESSION_RUNNING, "it runs");
    if (mine.state != XR_SESSION_STATE_READY || !told)
        return refuse(kCall, "begin_before_ready", XR_ERROR_SESSION_NOT_READY,
                      "the session has not been told to be READY");
    if (info->primaryViewConfigurationType != XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO)
        return refuse(kCall, "bad_views", XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED, "");
    mine.begun = true;
    mine.frame = FrameStage::idle;
    return XR_SUCCESS;
}

XrResult XRAPI_CALL end_session(XrSession session) {
    constexpr const char* kCall = "xrEndSession";
    if (const XrResult bad = check_session(session, kCall); bad)
        return bad;
    Session& mine = *world().session;
    if (!mine.begun)
        return refuse(kCall, "not_running", XR_ERROR_SESSION_NOT_RUNNING, "it does not run");
    if (mine.state != XR_SESSION_STATE_STOPPING)
        return refuse(kCall, "end_before_stopping", XR_ERROR_SESSION_NOT_STOPPING,
                      "the session is not STOPPING");
    mine.begun = false;
    push_state(XR_SESSION_STATE_IDLE);
    if (mine.exit_asked)
        push_state(XR_SESSION_STATE_EXITING);
    return XR_SUCCESS;
}

XrResult XRAPI_CALL request_exit(XrSession session) {
    constexpr const char* kCall = "xrRequestExitSession";
    if (const XrResult bad = check_session(session, kCall); bad)
        return bad;
    if (!world().session->begun)
        return refuse(kCall, "not_running", XR_ERROR_SESSION_NOT_RUNNING, "it does not run");
    world().session->exit_asked = true;
    return XR_SUCCESS;
}

} // namespace

std::vector<NamedEntry> session_entries() {
    return {named("xrCreateSession", create_session), named("xrDestroySession", destroy_session),
            named("xrBeginSession", begin_session), named("xrEndSession", end_session),
            named("xrRequestExitSession", request_exit)};
}

} // namespace isochron::played
