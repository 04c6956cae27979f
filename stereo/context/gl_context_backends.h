// The makers of each kind of GL context, and what they share; for gl_context*.cpp alone.
#pragma once

#include "stereo/context/gl_context.h"

#include <memory>
#include <string>
#include <vector>

namespace isochron::stereo {

/// There is no display, so that no other kind of context would bring a window either.
class NoDisplay : public render::Error {
  public:
    using render::Error::Error;
};

/// Each makes its context current. @throws render::Error with the reason alone (`make_context` adds
/// the kind and the alternatives)
std::unique_ptr<GlContext> make_glfw_context(const ContextOptions& options);
std::unique_ptr<GlContext> make_egl_context(const ContextOptions& options);
std::unique_ptr<GlContext> make_osmesa_context(const ContextOptions& options);

/// `OpenGL 4.5, llvmpipe (...)` of the current context.
std::string describe_current(const render::GlLoader& loader);

/// A context without a window: it draws into framebuffer objects of a size that stays as asked for.
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
