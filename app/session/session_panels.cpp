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
    return panel_.feed(events, state_.panel);
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
            .quad_buffered = outputs_.windows()[0].has_stereo_buffers()};
}

OperatorPanel::Model Session::panel_models(const FrameReport& report) const {
    return [this, &report](PanelPlace place) { return panel_model(place, report); };
}

void Session::draw_panel_overlay(glm::ivec2 size, const FrameReport& report) {
    if (state_.panel)
        interaction::merge(panel_commands_,
                           panel_.draw_over(size, panel_models(report), report.time));
}

} // namespace isochron::app
