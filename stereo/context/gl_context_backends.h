// Creation of each kind of GL context, and code that they share; only for gl_context*.cpp.
#pragma once

#include "stereo/context/gl_context.h"

#include <memory>
#include <string>
#include <vector>

namespace isochron::stereo {

/// There is no display, so no other kind of context can open a window either.
class NoDisplay : public render::Error {
  public:
    using render::Error::Error;
};

/// Each makes its context current. @throws render::Error with only the reason (`make_context` adds
/// the kind and the alternatives)
std::unique_ptr<GlContext> make_glfw_context(const ContextOptions& options);
std::unique_ptr<GlContext> make_egl_context(const ContextOptions& options);
std::unique_ptr<GlContext> make_osmesa_context(const ContextOptions& options);

/// Describes the current context: `OpenGL 4.5, llvmpipe (...)`.
std::string describe_current(const render::GlLoader& loader);

/// A context without a window: it draws into framebuffer objects of a fixed size.
class OffscreenContext : public GlContext {
  public:
    explicit OffscreenContext(glm::ivec2 size) : size_(size) {}
    glm::ivec2 framebuffer_size() const override { return size_; }
    bool has_window() const override { return false; }
    void present() override {}
    bool should_close() const override { return false; }
    std::vector<interaction::WindowEvent> poll_events() override { return {}; }

  private:
    glm::ivec2 size_;
};

} // namespace isochron::stereo
