// Shows a finished picture in a window, whichever context drew it.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/render_target.h"
#include "stereo/context/gl_context.h"

#include <optional>

namespace isochron::stereo {

/// All drawing happens in one context. A further window has a context of its own that shares its
/// textures and does nothing but copy the finished picture into the window's buffers.
class Presenter {
  public:
    /// @param drawing the context that draws, current now and after every call
    /// @param window the context of the window, the same one or one that shares its objects; both
    /// outlive the presenter
    Presenter(const render::Gl& gl, GlContext& drawing, GlContext& window);
    ~Presenter();
    Presenter(const Presenter&) = delete;
    Presenter& operator=(const Presenter&) = delete;

    /// Copies and swaps; without a window there is nothing to do.
    /// @param right the right buffer's picture, of the same size, in a window that has one; null:
    /// both eyes see `picture`
    void present(const render::RenderTarget& picture, const render::RenderTarget* right);

  private:
    void copy(const render::RenderTarget& picture, GLenum buffer) const;
    /// Makes a context current; what it does next happens after all that was done until now.
    void hand_over_to(GlContext& context) const;

    const render::Gl& gl_;
    GlContext& drawing_;
    GlContext& window_;
    /// Framebuffers are not shared between contexts: this one belongs to the window's.
    std::optional<render::Framebuffer> source_;
};

} // namespace isochron::stereo
