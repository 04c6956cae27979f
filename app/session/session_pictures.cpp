// A session's pictures to keep: captures, and what a replay writes.
#include "app/session/session.h"

#include "stereo/image_file.h"

#include <fmt/format.h>

#include <utility>

namespace isochron::app {

KeptPictures Session::kept_pictures() {
    return {
        gl_, windows_, config_, displays_, room_, [this](stereo::Display& display, std::size_t) {
            display.draw(drawn_->viewers, mode_in(display.window(), *drawn_),
                         [&](std::span<const render::View> views) {
                             scene_.draw(views, drawn_->room_from_physical, drawn_->footprint,
                                         drawn_->wand);
                         });
        }};
}

/// What the window beside the headset shows.
render::Image Session::headset_picture() {
    const stereo::DisplayOptions options =
        picture_options(gl_, config_, windows_[0].framebuffer_size());
    if (drawn_->eyes.empty() || options.samples == display_options(gl_, config_).samples) {
        headset_display_->mirror({});
        return headset_display_->read_window();
    }
    stereo::HeadsetDisplay picture(gl_, windows_.drawing(), windows_[0], config_.openxr.mirror,
                                   options);
    picture.draw(drawn_->eyes, [&](std::span<const render::View> views) {
        scene_.draw(views, drawn_->room_from_physical, drawn_->footprint, drawn_->wand);
    });
    picture.mirror({});
    return picture.read_window();
}

/// Of the room, or of every window of this process.
void Session::take_screenshots() {
    const std::string stem = fmt::format("isochron_{:04}", ++screenshots_taken_);
    if (room_)
        return write_image(kept_pictures().of_room(), screenshot_folder_ / (stem + ".png"));
    if (headset_)
        return write_image(headset_picture(), screenshot_folder_ / (stem + ".png"));
    const PictureNames names = picture_names(config_.installation);
    kept_pictures().each([&](std::size_t i, const stereo::Display& display) {
        write_image(display.read_window(),
                    screenshot_folder_ /
                        fmt::format("{}{}.png", stem, names.windows[windows_.number(i)].suffix));
    });
}

void Session::write_image(render::Image image, const std::filesystem::path& path) {
    pictures_.post([image = std::move(image), path] {
        stereo::write_image(image, path);
        return "saved " + path.string();
    });
}

} // namespace isochron::app
