// Events, drawing and presenting of the operator's panel, wherever it is.
#include "app/panel/operator_panel.h"

#include <utility>

namespace isochron::app {

OperatorPanel::OperatorPanel(const render::Gl& gl, const stereo::Windows& windows)
    : first_(windows.first()), over_(gl) {
    if (windows.console())
        console_.emplace(gl, windows.drawing(), *windows.console());
}

std::vector<interaction::WindowEvent>
OperatorPanel::feed(std::span<const interaction::WindowEvent> events, bool shown) {
    if (!console_)
        return over_.feed(events, shown);
    std::vector<interaction::WindowEvent> all = console_->take_events();
    all.insert(all.end(), events.begin(), events.end());
    return all;
}

interaction::Commands OperatorPanel::draw_over(glm::ivec2 picture, const Model& model,
                                               interaction::Seconds time) {
    if (!first_.has_window() || console_)
        return {};
    // The right buffer of a quad-buffered window shows what was laid out for the left one.
    interaction::Commands commands;
    if (!std::exchange(laid_out_, true))
        commands = over_.lay_out(picture, model(PanelPlace::over), time);
    over_.draw(picture);
    return commands;
}

interaction::Commands OperatorPanel::draw_alone(const Model& model, interaction::Seconds time) {
    return console_ ? console_->draw(model(PanelPlace::whole), time) : interaction::Commands();
}

void OperatorPanel::present() {
    laid_out_ = false;
    if (console_)
        console_->present();
}

} // namespace isochron::app
