// Events, drawing and presenting of the operator's panel.
#include "app/panel/operator_panel.h"

#include <glm/common.hpp>

#include <algorithm>
#include <utility>

namespace isochron::app {

OperatorPanel::OperatorPanel(const render::Gl& gl, const stereo::Windows& windows, float font_scale)
    : first_(windows.first()), font_scale_(font_scale), over_(gl) {
    if (windows.console())
        console_.emplace(gl, windows.drawing(), *windows.console(), font_scale);
}

std::optional<MovieWish> OperatorPanel::take_wanted_movie() {
    return console_ ? console_->take_wanted_movie() : over_.take_wanted_movie();
}

std::optional<OfferedSession> OperatorPanel::take_continued() {
    return console_ ? console_->take_continued() : over_.pages().take_continued();
}

DesktopWish OperatorPanel::take_desktop_wish() {
    return console_ ? console_->take_desktop_wish() : over_.pages().take_desktop_wish();
}

std::vector<interaction::WindowEvent>
OperatorPanel::feed(std::span<const interaction::WindowEvent> events, bool shown) {
    if (!console_)
        return over_.feed(events, shown);
    std::vector<interaction::WindowEvent> all = console_->take_events();
    all.insert(all.end(), events.begin(), events.end());
    return all;
}

interaction::Commands OperatorPanel::lay_out_over(glm::ivec2 picture, glm::ivec2 places,
                                                  const Model& model, interaction::Seconds time) {
    // The right buffer of a quad-buffered window shows the layout that was made for the left one.
    if (!first_.has_window() || console_ || std::exchange(laid_out_, true))
        return {};
    const glm::ivec2 part = picture / places;
    over_.repeat(places);
    over_.set_scale(panel_scale(first_, font_scale_, part.x));
    return over_.lay_out(part, model(PanelPlace::over), time);
}

interaction::Commands OperatorPanel::draw_over(glm::ivec2 picture, glm::ivec2 places,
                                               const Model& model, interaction::Seconds time) {
    if (!first_.has_window() || console_)
        return {};
    interaction::Commands commands = lay_out_over(picture, places, model, time);
    const glm::ivec2 part = picture / places;
    for (int y = 0; y < places.y; ++y)
        for (int x = 0; x < places.x; ++x)
            over_.draw(part, glm::ivec2(x, y) * (picture - part));
    return commands;
}

interaction::Commands OperatorPanel::draw_alone(const Model& model, interaction::Seconds time) {
    return console_ ? console_->draw(model(PanelPlace::whole), time) : interaction::Commands();
}

stereo::Margins OperatorPanel::covered(glm::ivec2 size, const PanelRows& rows) const {
    if (console_ || !first_.has_window())
        return {};
    const float scale = panel_scale(first_, font_scale_, size.x);
    const glm::vec2 window = glm::vec2(size) / scale;
    const PanelBox free = layout_in(PanelPlace::over, window, rows).picture;
    if (!has_room_for_picture(free, window))
        return {};
    const glm::ivec2 low(glm::round(scale * free.low)), high(glm::round(scale * free.high));
    return {.left = low.x, .top = low.y, .bottom = size.y - high.y};
}

float OperatorPanel::text_share(glm::ivec2 size) const {
    return panel_scale(first_, font_scale_, size.x) * PanelLayer::kFontPixels /
           static_cast<float>(std::max(1, size.y));
}

bool OperatorPanel::covers(const interaction::MouseMoveEvent& cursor) const {
    return !console_ && cursor.window == 0 && over_.covers({cursor.x, cursor.y});
}

void OperatorPanel::present(bool again) {
    laid_out_ = false;
    if (console_)
        console_->present(again);
}

} // namespace isochron::app
