// The test pattern in every window of an installation.
#include "app/loop/pattern_show.h"

#include "interaction/input/actions.h"

#include <utility>

namespace isochron::app {

using interaction::Commands;
using interaction::InputState;

PatternShow::PatternShow(Config config, stereo::Windows windows)
    : config_(std::move(config)), outputs_(config_, std::move(windows)), pattern_(outputs_.gl()),
      mode_(config_.installation.windows.front().stereo),
      eye_separation_(config_.installation.viewers.front().eye_separation) {}

void PatternShow::obey(const Commands& commands) {
    if (commands.stereo)
        mode_ = stereo::stereo_mode_from_name(*commands.stereo).value_or(mode_);
    eye_separation_ = commands.eye_separation.value_or(eye_separation_);
}

Commands PatternShow::commands_from(const InputState& input) {
    interaction::Settings settings;
    settings.eye_separation = eye_separation_;
    settings.stereo = stereo::name_of(mode_);
    interaction::Commands commands =
        controls_.update(input, {.settings = settings, .stereo_modes = &outputs_.stereo_modes()});
    const interaction::DeviceState* keys = input.find("keys");
    const bool escapes = keys && holds(keys->actions, interaction::Action::quit);
    commands.quit = commands.leaving.has_value() || escapes; // there is nothing to lose
    return commands;
}

bool PatternShow::should_close() const {
    return outputs_.windows().should_close() || frames_->close_wanted();
}

void PatternShow::frame(const InputState& input, const Commands& commands, const Latch& latch) {
    const Latch heads =
        frames_->begin(input, commands, Waiting::never, latch, config_.installation);
    obey(commands);
    seen_ = heads ? with_heads(input, viewers_heads(heads(), config_.installation)) : input;
    const interaction::DeviceState* wand = seen_.find("wand");
    Audience audience;
    audience.viewers = viewer_poses(config_.installation, seen_, eye_separation_);
    audience.wand = wand ? wand->pose : std::nullopt;
    audience.stereo = mode_;
    const auto scene = [this](const ScenePlace& place, std::span<const render::View> views) {
        draw(place, views);
    };
    outputs_.draw(audience, scene, {});
    outputs_.draw_room(input, {});
    frames_->swap_barrier([this] {
        outputs_.gl().Finish();
        FrameAnswer answer;
        answer.close = outputs_.windows().should_close();
        return answer;
    });
    outputs_.present();
}

void PatternShow::draw(const ScenePlace& place, std::span<const render::View> views) {
    const std::size_t number = place.window->viewports[place.viewport].viewer;
    const stereo::ViewerPose& viewer = outputs_.audience().viewers[number];
    const PatternWall wall =
        pattern_wall(*place.window, place.viewport, config_.installation.viewers[number],
                     viewer.head, viewer.eyes, views.front().size);
    pattern_.draw(views, eyes_of(place.mode), wall, seen_);
}

} // namespace isochron::app
