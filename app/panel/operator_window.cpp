// Events, drawing and presenting of the operator's window.
#include "app/panel/operator_window.h"

#include <algorithm>
#include <utility>
#include <variant>

namespace isochron::app {
namespace {

/// At least one pixel: a minimized window has none.
glm::ivec2 drawable(glm::ivec2 size) {
    return glm::max(size, glm::ivec2(1));
}

} // namespace

float panel_scale(const stereo::GlContext& window, float font_scale, int width) {
    constexpr float kNarrowest = 300.0f;
    const float room = std::max(1.0f, static_cast<float>(width) / kNarrowest);
    return std::min(font_scale * window.content_scale(), room);
}

Console::Console(const render::Gl& gl, stereo::GlContext& drawing, stereo::GlContext& window,
                 float font_scale)
    : window_(window), font_scale_(font_scale), layer_(gl),
      picture_(gl, drawable(window.framebuffer_size())), presenter_(gl, drawing, window) {}

std::vector<interaction::WindowEvent> Console::take_events() {
    const auto events = window_.poll_events();
    std::vector<interaction::WindowEvent> left = layer_.feed(events, true);
    std::erase_if(left, [](const interaction::WindowEvent& event) {
        return !std::holds_alternative<interaction::KeyEvent>(event);
    });
    return left;
}

interaction::Commands Console::draw(const PanelModel& model, interaction::Seconds time) {
    const glm::ivec2 size = drawable(window_.framebuffer_size());
    layer_.set_scale(panel_scale(window_, font_scale_, size.x));
    interaction::Commands commands = layer_.lay_out(size, model, time);
    if (size == picture_.size() && layer_.digest() == drawn_)
        return commands;
    picture_.resize(size);
    picture_.clear({0, 0, 0, 1});
    picture_.bind();
    layer_.draw(size);
    drawn_ = layer_.digest();
    fresh_ = true;
    return commands;
}

void Console::present(bool again) {
    if (std::exchange(fresh_, false) || again)
        presenter_.present(picture_, nullptr);
}

} // namespace isochron::app
