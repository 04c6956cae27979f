// Shows a finished picture in a window, whichever context drew it.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/gl/render_target.h"
#include "stereo/context/gl_context.h"

#include <optional>

namespace isochron::stereo {

/// All drawing happens in one context. Further windows have their own contexts, which share its
/// textures and only copy the finished picture into the window's buffers.
class Presenter {
  public:
    /// @param drawing the drawing context, current now and after every call
    /// @param window the window's context: the same one, or one that shares its objects; both
    /// outlive the presenter
    Presenter(const render::Gl& gl, GlContext& drawing, GlContext& window);
    ~Presenter();
    Presenter(const Presenter&) = delete;
    Presenter& operator=(const Presenter&) = delete;

    /// Copies the picture and swaps; does nothing without a window.
    /// @param right picture of the right buffer, with the same size, if the window has one; null:
    /// both eyes see `picture`
    void present(const render::RenderTarget& picture, const render::RenderTarget* right);

  private:
    void copy(const render::RenderTarget& picture, GLenum buffer) const;
    /// Makes a context current; its commands run after all earlier commands of the other one.
    void hand_over_to(GlContext& context) const;

    const render::Gl& gl_;
    GlContext& drawing_;
    GlContext& window_;
    /// Framebuffers are not shared between contexts: this one belongs to the window's context.
    std::optional<render::Framebuffer> source_;
};

} // namespace isochron::stereo
