// The pictures that an OpenXR runtime shows: its own textures, into which finished ones are copied.
#pragma once

#include "render/gl/gl_objects.h"

#include <glm/vec2.hpp>

#include <openxr/openxr.h>

#include <optional>
#include <span>
#include <vector>

namespace isochron::stereo {

/// The contents of a swapchain's pictures.
enum class SwapchainContent : std::uint8_t { color, depth };

/// The format to use among those that a runtime offers. Color: sRGB, else linear light in half
/// floats. Depth: only 32-bit floats, as drawn depth can be copied only to these. Empty if none
/// fits.
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
    /// The whole newest picture.
    XrSwapchainSubImage image() const;

  private:
    const render::Gl* gl_;
    SwapchainContent content_;
    glm::ivec2 size_;
    XrSwapchain swapchain_ = XR_NULL_HANDLE;
    std::vector<render::Framebuffer> framebuffers_; ///< one for each texture
};

} // namespace isochron::stereo
