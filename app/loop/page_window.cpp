// A window with nothing but one page of the panel.
#include "app/loop/page_window.h"

#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include <utility>

namespace isochron::app {
namespace {

stereo::GlContext& made_current(stereo::GlContext& window) {
    window.make_current();
    return window;
}

} // namespace

PageWindow::PageWindow(const stereo::Windows& windows, PageWindowOptions options)
    : windows_(windows), options_(std::move(options)), window_(made_current(windows.first())),
      gl_(window_.loader()), layer_(gl_),
      picture_(gl_, glm::max(window_.framebuffer_size(), glm::ivec2(1))),
      presenter_(gl_, window_, window_), pacer_(options_.frame_rate_limit) {}

std::vector<interaction::WindowEvent>
PageWindow::frame(const std::function<void(glm::ivec2 size, interaction::Seconds time)>& lay_out) {
    const auto longest = idle_.after(layer_.outlook(), now());
    if (longest && options_.wake)
        windows_.wait(*options_.wake, *longest);
    auto rest = layer_.feed(windows_.poll_events(), true);
    if (windows_.take_damage())
        shown_.reset();
    const glm::ivec2 size = window_.framebuffer_size();
    if (size.x > 0 && size.y > 0) { // a minimized window has none
        layer_.set_scale(panel_scale(window_, options_.font_scale, size.x));
        lay_out(size, now());
    }
    if (size.x > 0 && size.y > 0 && (size != picture_.size() || layer_.digest() != shown_)) {
        shown_ = layer_.digest();
        picture_.resize(size);
        picture_.clear(glm::vec4(options_.background, 1));
        picture_.bind();
        layer_.draw(size);
        presenter_.present(picture_, nullptr);
    }
    if (options_.others)
        options_.others->insert(options_.others->end(), rest.begin(), rest.end());
    pacer_.wait();
    return rest;
}

} // namespace isochron::app
