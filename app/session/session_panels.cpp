// A session's panels: what they are told, what they lead to, and where they lie.
#include "app/session/session.h"

#include <utility>

namespace isochron::app {
namespace {

/// Frames over which the panel summarizes frame times.
constexpr std::size_t kShownFrames = 120;

} // namespace

interaction::Commands Session::take_panel_commands() {
    return std::exchange(panel_commands_, {});
}

std::vector<interaction::WindowEvent>
Session::panel_events(std::span<const interaction::WindowEvent> events) {
    if (!console_)
        return panel_.feed(events, state_.panel);
    std::vector<interaction::WindowEvent> all = console_->take_events();
    all.insert(all.end(), events.begin(), events.end());
    return all;
}

PanelModel Session::panel_model(PanelPlace place, const FrameReport& report) const {
    const auto scale = color_scale(state_, *file_);
    return {.info = file_->info(),
            .stats = file_->stats(),
            .asked = state_,
            .second_array = file_->color() != nullptr,
            .whole_range = scale ? scale->whole : std::array{0.0, 0.0},
            .frame = report,
            .frame_times = log_.stage(&FrameReport::total, kShownFrames),
            .frames_per_second = log_.frames_per_second(kShownFrames),
            .searching = extractor_.busy(),
            .recording = recording_,
            .failure = failure(),
            .message = message_,
            .controls = documentation_,
            .place = place,
            .quad_buffered = windows_[0].has_stereo_buffers()};
}

void Session::draw_panel_overlay(glm::ivec2 size, const FrameReport& report) {
    if (!state_.panel || !windows_.first().has_window() || console_)
        return;
    // The right buffer of a quad-buffered window shows what was laid out for the left one.
    if (!std::exchange(panel_drawn_, true))
        interaction::merge(
            panel_commands_,
            panel_.lay_out(size, panel_model(PanelPlace::over, report), report.time));
    panel_.draw(size);
}

} // namespace isochron::app
