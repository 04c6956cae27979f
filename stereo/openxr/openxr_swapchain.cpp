// Acquires, fills and releases an OpenXR runtime's textures.
#include "stereo/openxr/openxr_swapchain.h"

#include "stereo/openxr/openxr_error.h"

#define XR_USE_GRAPHICS_API_OPENGL
#include <openxr/openxr_platform.h>

#include <algorithm>
#include <array>

namespace isochron::stereo {

std::optional<std::int64_t> chosen_format(std::span<const std::int64_t> offered,
                                          SwapchainContent content) {
    constexpr std::array<std::int64_t, 2> kColors{GL_SRGB8_ALPHA8, GL_RGBA16F};
    constexpr std::array<std::int64_t, 1> kDepths{GL_DEPTH_COMPONENT32F};
    const auto wanted = content == SwapchainContent::color ? std::span<const std::int64_t>(kColors)
                                                           : std::span<const std::int64_t>(kDepths);
    for (const std::int64_t format : wanted)
        if (std::ranges::find(offered, format) != offered.end())
            return format;
    return std::nullopt;
}

OpenXrSwapchain::OpenXrSwapchain(const render::Gl& gl, XrSession session, SwapchainContent content,
                                 std::int64_t format, glm::ivec2 size)
    : gl_(&gl), content_(content), size_(size) {
    XrSwapchainCreateInfo info{XR_TYPE_SWAPCHAIN_CREATE_INFO};
    info.usageFlags = content == SwapchainContent::color
                          ? XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT
                          : XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    info.format = format;
    info.sampleCount = info.faceCount = info.arraySize = info.mipCount = 1;
    info.width = static_cast<std::uint32_t>(size.x);
    info.height = static_cast<std::uint32_t>(size.y);
    check(xrCreateSwapchain(session, &info, &swapchain_), "xrCreateSwapchain");
    const auto images = enumerated<XrSwapchainImageOpenGLKHR>(
        "xrEnumerateSwapchainImages", {XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR},
        [&](std::uint32_t capacity, std::uint32_t* count, XrSwapchainImageOpenGLKHR* list) {
            return xrEnumerateSwapchainImages(swapchain_, capacity, count,
                                              reinterpret_cast<XrSwapchainImageBaseHeader*>(list));
        });
    const GLenum attachment =
        content == SwapchainContent::color ? GL_COLOR_ATTACHMENT0 : GL_DEPTH_ATTACHMENT;
    for (const XrSwapchainImageOpenGLKHR& image : images)
        gl.NamedFramebufferTexture(framebuffers_.emplace_back(gl).name(), attachment, image.image,
                                   0);
}

OpenXrSwapchain::~OpenXrSwapchain() {
    framebuffers_.clear();
    xrDestroySwapchain(swapchain_);
}

void OpenXrSwapchain::copy_from(GLuint framebuffer, glm::ivec2 corner) {
    std::uint32_t index = 0;
    const XrSwapchainImageAcquireInfo acquire{XR_TYPE_SWAPCHAIN_IMAGE_ACQUIRE_INFO};
    const XrSwapchainImageReleaseInfo release{XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO};
    check(xrAcquireSwapchainImage(swapchain_, &acquire, &index), "xrAcquireSwapchainImage");
    XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO};
    wait.timeout = XR_INFINITE_DURATION;
    check(xrWaitSwapchainImage(swapchain_, &wait), "xrWaitSwapchainImage");
    gl_->Disable(GL_SCISSOR_TEST);
    gl_->Enable(GL_FRAMEBUFFER_SRGB); // copies linear light, however each side stores it
    const glm::ivec2 end = corner + size_;
    gl_->BlitNamedFramebuffer(framebuffer, framebuffers_.at(index).name(), corner.x, corner.y,
                              end.x, end.y, 0, 0, size_.x, size_.y,
                              content_ == SwapchainContent::color ? GL_COLOR_BUFFER_BIT
                                                                  : GL_DEPTH_BUFFER_BIT,
                              GL_NEAREST);
    check(xrReleaseSwapchainImage(swapchain_, &release), "xrReleaseSwapchainImage");
}

XrSwapchainSubImage OpenXrSwapchain::image() const {
    return {swapchain_, {{0, 0}, {size_.x, size_.y}}, 0};
}

} // namespace isochron::stereo
