// The test pattern in every window of an installation.
#include "app/session/pattern_show.h"

#include "stereo/image_file.h"

#include <utility>

namespace isochron::app {

using interaction::Commands;
using interaction::InputState;

PatternShow::PatternShow(Config config, stereo::Windows windows)
    : config_(std::move(config)), windows_(std::move(windows)), gl_(windows_.drawing().loader()),
      displays_(make_displays(gl_, windows_, config_)), pattern_(gl_),
      stereo_modes_(live_stereo_modes(windows_)),
      mode_(config_.installation.windows.front().stereo),
      eye_separation_(config_.installation.viewers.front().eye_separation) {
    if (windows_.room())
        room_.emplace(gl_, *windows_.room(), config_.installation);
    picture_options(gl_, config_, {1, 1}); // wrong ones are told now, not when the first is taken
}

void PatternShow::obey(const Commands& commands) {
    if (commands.stereo)
        mode_ = stereo::stereo_mode_from_name(*commands.stereo).value_or(mode_);
    eye_separation_ = commands.eye_separation.value_or(eye_separation_);
}

Commands PatternShow::commands_from(const InputState& input) {
    interaction::ControlContext context;
    context.eye_separation = eye_separation_;
    context.stereo = stereo::name_of(mode_);
    context.stereo_modes = &stereo_modes_;
    return controls_.update(input, context);
}

void PatternShow::frame(const InputState& input, const Latch& latch) {
    seen_ = latch ? with_heads(input, viewers_heads(latch(), config_.installation)) : input;
    viewers_ = viewpoints(config_.installation, seen_, eye_separation_);
    for (std::size_t i = 0; i < displays_.size(); ++i)
        draw(displays_[i], i);
    if (room_) {
        const interaction::DeviceState* wand = seen_.find("wand");
        room_->draw(displays_, viewers_, wand ? wand->pose : std::nullopt, input, {});
    }
    for (stereo::Display& display : displays_)
        display.present();
    if (room_)
        room_->present();
}

void PatternShow::draw(stereo::Display& display, std::size_t window) {
    const stereo::Installation& installation = config_.installation;
    const stereo::Window& shown = installation.windows[window];
    const stereo::StereoMode configured = mode_of(shown, installation, mode_);
    const stereo::StereoMode mode = room_ ? RoomView::shown(configured) : configured;
    std::size_t viewport = 0;
    display.draw(viewers_, mode, [&](std::span<const render::View> views) {
        const std::size_t number = shown.viewports[viewport].viewer;
        const PatternWall wall =
            pattern_wall(shown, viewport, installation.viewers[number], viewers_[number].head,
                         viewers_[number].eye_separation, views.front().size);
        pattern_.draw(views, eyes_of(mode), wall, seen_);
        ++viewport;
    });
}

KeptPictures PatternShow::kept_pictures() {
    return {
        gl_,     windows_,
        config_, displays_,
        room_,   [this](stereo::Display& display, std::size_t window) { draw(display, window); }};
}

void PatternShow::write_image(render::Image image, const std::filesystem::path& path) {
    pictures_.post([image = std::move(image), path] {
        stereo::write_image(image, path);
        return "saved " + path.string();
    });
}

} // namespace isochron::app
