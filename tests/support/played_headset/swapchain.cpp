// The played runtime's swapchains: textures of the program's own GL context.
#include "tests/support/played_headset/world.h"

namespace isochron::played {
namespace {

constexpr std::uint32_t kImages = 3;
constexpr GLsizei kMostPixels = 4096; ///< along a side

XrResult check_swapchain(XrSwapchain handle, const char* call, Swapchain*& found) {
    const auto at = world().swapchains.find(id_of(handle));
    if (at == world().swapchains.end())
        return refuse(call, "dead_handle", XR_ERROR_HANDLE_INVALID, "no such swapchain");
    found = &at->second;
    return check_session(reinterpret_cast<XrSession>(world().session_handle), call);
}

/// Checks that the session's GL context is current, as the runtime's GL calls need it.
bool context_is_current(const char* call) {
    const Session& session = *world().session;
    if (session.current_context() == session.context)
        return true;
    refuse(call, "context_not_current", XR_ERROR_RUNTIME_FAILURE,
           "another context than the session's is current");
    return false;
}

XrResult XRAPI_CALL enumerate_formats(XrSession session, std::uint32_t capacity,
                                      std::uint32_t* count, std::int64_t* out) {
    if (const XrResult bad = check_session(session, "xrEnumerateSwapchainFormats"); bad)
        return bad;
    const auto& formats = world().headset.formats;
    return fill(formats.size(), capacity, count, out,
                [&](std::int64_t& to, std::size_t i) { to = formats[i]; });
}

XrResult XRAPI_CALL create(XrSession session, const XrSwapchainCreateInfo* info, XrSwapchain* out) {
    constexpr const char* kCall = "xrCreateSwapchain";
    if (const XrResult bad = check_session(session, kCall); bad)
        return bad;
    if (!has_type(info, XR_TYPE_SWAPCHAIN_CREATE_INFO, kCall) || !context_is_current(kCall))
        return XR_ERROR_VALIDATION_FAILURE;
    const auto& formats = world().headset.formats;
    if (std::find(formats.begin(), formats.end(), info->format) == formats.end())
        return refuse(kCall, "format_not_offered", XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED,
                      std::to_string(info->format));
    if (info->width < 1 || info->height < 1 || info->width > kMostPixels ||
        info->height > kMostPixels || info->arraySize < 1 || info->faceCount != 1 ||
        info->mipCount < 1 || info->sampleCount < 1)
        return refuse(kCall, "bad_size", XR_ERROR_VALIDATION_FAILURE, "size, faces or layers");
    *out = new_handle<XrSwapchain>();
    Swapchain& made = world().swapchains[id_of(*out)];
    made.info = *info;
    const render::Gl& gl = *world().session->gl;
    const bool array = info->arraySize > 1;
    made.textures.resize(kImages);
    const auto width = static_cast<GLsizei>(info->width);
    const auto height = static_cast<GLsizei>(info->height);
    const auto format = static_cast<GLenum>(info->format);
    gl.CreateTextures(array ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D, kImages, made.textures.data());
    for (const GLuint texture : made.textures)
        if (array)
            gl.TextureStorage3D(texture, 1, format, width, height,
                                static_cast<GLsizei>(info->arraySize));
        else
            gl.TextureStorage2D(texture, 1, format, width, height);
    return XR_SUCCESS;
}

XrResult XRAPI_CALL destroy(XrSwapchain handle) {
    const auto at = world().swapchains.find(id_of(handle));
    if (at == world().swapchains.end())
        return refuse("xrDestroySwapchain", "dead_handle", XR_ERROR_HANDLE_INVALID,
                      "no such swapchain");
    if (context_is_current("xrDestroySwapchain"))
        world().session->gl->DeleteTextures(kImages, at->second.textures.data());
    world().swapchains.erase(at);
    return XR_SUCCESS;
}

XrResult XRAPI_CALL images(XrSwapchain handle, std::uint32_t capacity, std::uint32_t* count,
                           XrSwapchainImageBaseHeader* out) {
    constexpr const char* kCall = "xrEnumerateSwapchainImages";
    Swapchain* swapchain = nullptr;
    if (const XrResult bad = check_swapchain(handle, kCall, swapchain); bad)
        return bad;
    return fill(kImages, capacity, count, reinterpret_cast<XrSwapchainImageOpenGLKHR*>(out),
                [&](XrSwapchainImageOpenGLKHR& to, std::size_t i) {
                    has_type(&to, XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR, kCall);
                    to.image = swapchain->textures[i];
                });
}

XrResult XRAPI_CALL acquire(XrSwapchain handle, const XrSwapchainImageAcquireInfo* info,
                            std::uint32_t* index) {
    constexpr const char* kCall = "xrAcquireSwapchainImage";
    Swapchain* swapchain = nullptr;
    if (const XrResult bad = check_swapchain(handle, kCall, swapchain); bad)
        return bad;
    if (info)
        has_type(info, XR_TYPE_SWAPCHAIN_IMAGE_ACQUIRE_INFO, kCall);
    if (swapchain->acquired.size() == kImages)
        return refuse(kCall, "acquired_all", XR_ERROR_CALL_ORDER_INVALID, "every image is taken");
    *index = swapchain->next;
    swapchain->next = (swapchain->next + 1) % kImages;
    swapchain->acquired.push_back(*index);
    return XR_SUCCESS;
}

XrResult XRAPI_CALL wait(XrSwapchain handle, const XrSwapchainImageWaitInfo* info) {
    constexpr const char* kCall = "xrWaitSwapchainImage";
    Swapchain* swapchain = nullptr;
    if (const XrResult bad = check_swapchain(handle, kCall, swapchain); bad)
        return bad;
    has_type(info, XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, kCall);
    if (swapchain->acquired.empty() || swapchain->waited)
        return refuse(kCall, "wait_without_acquire", XR_ERROR_CALL_ORDER_INVALID,
                      "no image is acquired that was not waited for");
    swapchain->waited = true;
    return XR_SUCCESS;
}

XrResult XRAPI_CALL release(XrSwapchain handle, const XrSwapchainImageReleaseInfo* info) {
    constexpr const char* kCall = "xrReleaseSwapchainImage";
    Swapchain* swapchain = nullptr;
    if (const XrResult bad = check_swapchain(handle, kCall, swapchain); bad)
        return bad;
    if (info)
        has_type(info, XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO, kCall);
    if (!swapchain->waited)
        return refuse(kCall, "release_without_wait", XR_ERROR_CALL_ORDER_INVALID,
                      "the oldest image was not waited for");
    swapchain->released = swapchain->acquired.front();
    world().session->filled = world().session->located;
    swapchain->acquired.pop_front();
    swapchain->waited = false;
    return XR_SUCCESS;
}

} // namespace

std::vector<NamedEntry> swapchain_entries() {
    return {named("xrEnumerateSwapchainFormats", enumerate_formats),
            named("xrCreateSwapchain", create),
            named("xrDestroySwapchain", destroy),
            named("xrEnumerateSwapchainImages", images),
            named("xrAcquireSwapchainImage", acquire),
            named("xrWaitSwapchainImage", wait),
            named("xrReleaseSwapchainImage", release)};
}

} // namespace isochron::played
