// Pictures that an OpenXR runtime shows: textures of its own, into which finished ones are copied.
#pragma once

#include "render/gl/gl_objects.h"

#include <glm/vec2.hpp>

#include <openxr/openxr.h>

#include <optional>
#include <span>
#include <vector>

namespace isochron::stereo {

/// What a swapchain's pictures hold.
enum class SwapchainContent : std::uint8_t { color, depth };

/// The format to take out of those that a runtime offers: display values as sRGB, or else light in
/// half floats; depth only as 32-bit float, which is what is drawn and can be copied.
std::optional<std::int64_t> chosen_format(std::span<const std::int64_t> offered,
                                          SwapchainContent content);

class OpenXrSwapchain {
  public:
    /// @throws OpenXrError
    OpenXrSwapchain(const render::Gl& gl, XrSession session, SwapchainContent content,
                    std::int64_t format, glm::ivec2 size);
    ~OpenXrSwapchain();
    OpenXrSwapchain(const OpenXrSwapchain&) = delete;
    OpenXrSwapchain& operator=(const OpenXrSwapchain&) = delete;

    /// Copies a part of a framebuffer into the next picture and gives it to the runtime.
    /// @param corner lower left of the part, which has the pictures' size @throws OpenXrError
    void copy_from(GLuint framebuffer, glm::ivec2 corner);
    /// All of the newest picture.
    XrSwapchainSubImage image() const;

  private:
    const render::Gl* gl_;
    SwapchainContent content_;
    glm::ivec2 size_;
    XrSwapchain swapchain_ = XR_NULL_HANDLE;
    std::vector<render::Framebuffer> framebuffers_; ///< by picture
};

} // namespace isochron::stereo
