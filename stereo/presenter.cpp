// Copies finished pictures into the buffers of windows.
#include "stereo/presenter.h"

namespace isochron::stereo {

Presenter::Presenter(const render::Gl& gl, GlContext& drawing, GlContext& window)
    : gl_(gl), drawing_(drawing), window_(window) {
    if (!window_.has_window())
        return;
    hand_over_to(window_);
    source_.emplace(gl_);
    hand_over_to(drawing_);
}

Presenter::~Presenter() {
    if (!source_)
        return;
    hand_over_to(window_);
    source_.reset();
    hand_over_to(drawing_);
}

void Presenter::hand_over_to(GlContext& context) const {
    if (&drawing_ == &window_)
        return;
    GLsync done = gl_.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl_.Flush(); // without it the other context might wait forever for the fence
    context.make_current();
    gl_.WaitSync(done, 0, GL_TIMEOUT_IGNORED);
    gl_.DeleteSync(done);
}

void Presenter::copy(const render::RenderTarget& picture, GLenum buffer) const {
    const glm::ivec2 size = picture.size();
    gl_.NamedFramebufferTexture(source_->name(), GL_COLOR_ATTACHMENT0, picture.color_texture(), 0);
    // Mesa 22.3 loses the window's buffers if they are chosen without being bound.
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    gl_.DrawBuffer(buffer);
    gl_.BlitNamedFramebuffer(source_->name(), 0, 0, 0, size.x, size.y, 0, 0, size.x, size.y,
                             GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Presenter::present(const render::RenderTarget& picture, const render::RenderTarget* right) {
    if (!source_)
        return;
    hand_over_to(window_);
    gl_.Disable(GL_SCISSOR_TEST);
    gl_.Disable(GL_FRAMEBUFFER_SRGB); // a window takes display values as they are
    if (right && window_.has_stereo_buffers()) {
        copy(picture, GL_BACK_LEFT);
        copy(*right, GL_BACK_RIGHT);
    } else {
        copy(picture, GL_BACK); // writes both back buffers if there are two
    }
    window_.present();
    hand_over_to(drawing_);
}

} // namespace isochron::stereo
