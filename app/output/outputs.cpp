// Draws, presents and keeps pictures in windows, in an emulated room, or in a headset.
#include "app/output/outputs.h"

#include "app/end_in_time.h"
#include "app/output/picture_names.h"
#include "app/text.h"
#include "app/version.h"
#include "render/gl/driver.h"
#include "render/gl/gl_memory.h"
#include "stereo/image_file.h"

#include <fmt/format.h>

#include <glm/common.hpp>

#include <algorithm>
#include <utility>

namespace isochron::app {
namespace {

/// Size of a picture that shows what a window shows beside its panel.
glm::ivec2 size_beside_panel(const stereo::Display& display) {
    if (display.window().viewports.size() != 1)
        return display.size();
    const glm::ivec2 eye = display.eye_size(0);
    switch (stereo::upright(display.mode())) {
    case stereo::StereoMode::side_by_side: return {2 * eye.x, eye.y};
    case stereo::StereoMode::top_bottom: return {eye.x, 2 * eye.y};
    default: return eye;
    }
}

/// Whether a window shows the picture of one eye, and nothing else.
bool is_one_eye(const stereo::Display& display) {
    const auto& viewports = display.window().viewports;
    return viewports.size() == 1 && !viewports.front().upside_down &&
           viewports.front().size == glm::vec2(1.0f) && stereo::eyes_of(display.mode()).size() == 1;
}

interaction::WrittenPictures written_in(const PictureNote& frame) {
    return frame.state.pictures.value_or(interaction::WrittenPictures{});
}

int passes_of(const Config& config, const render::Gl& gl) {
    const bool automatic = config.pictures.passes == 0 && config.rendering.samples == 0 &&
                           config.pictures.samples == 0;
    return automatic ? std::max(1, kSettledSamples / display_options(gl, config).samples) : 1;
}

} // namespace

Outputs::Outputs(const Config& config, stereo::Windows windows,
                 std::unique_ptr<stereo::Headset> headset)
    : config_(config), windows_(std::move(windows)),
      gl_(windows_.drawing().loader(), config_.rendering.drawn_by),
      passes_(headset || windows_.room() ? 1 : passes_of(config_, gl_)), in_flight_(gl_),
      displays_(headset && config_.openxr.options.windowless
                    ? std::deque<stereo::Display>()
                    : make_displays(gl_, windows_, config_)),
      headset_(std::move(headset)), stereo_modes_(live_stereo_modes(windows_)) {
    if (headset_) {
        headset_display_.emplace(gl_, windows_.drawing(), windows_[0], config_.openxr.mirror,
                                 display_options(gl_, config_));
        headset_->attach(windows_.drawing(), gl_);
    }
    if (windows_.room())
        room_.emplace(gl_, *windows_.room(), config_.installation);
    picture_options(gl_, config_,
                    {1, 1}); // report wrong options now, not with the first screenshot
}

Outputs::~Outputs() {
    if (headset_)
        headset_->detach();
}

std::vector<glm::ivec2> Outputs::window_sizes() const {
    std::vector<glm::ivec2> sizes;
    for (std::size_t i = 0; i < windows_.count(); ++i)
        sizes.push_back(windows_[i].framebuffer_size());
    return sizes;
}

std::vector<stereo::HeadsetEye> Outputs::headset_eyes() const {
    return headset_ ? headset_->eyes() : std::vector<stereo::HeadsetEye>();
}

std::size_t Outputs::viewports(const Audience& audience) const {
    std::size_t count = headset_ && !audience.eyes.empty() ? 1 : 0;
    if (shows_windows(audience))
        for (const stereo::Display& display : displays_)
            count += display.window().viewports.size();
    return count;
}

std::optional<interaction::Pose>
Outputs::ray_at(const interaction::MouseMoveEvent& cursor,
                std::span<const stereo::ViewerPose> viewers) const {
    if (room_ || !shows_windows() || cursor.window >= displays_.size())
        return std::nullopt;
    return displays_[cursor.window].ray_at(viewers, {cursor.x, 1.0f - cursor.y});
}

/// Whether the first window's screens adapt to the shape of the window.
bool Outputs::adapts() const {
    return !room_ && !displays_.empty() &&
           std::ranges::all_of(
               displays_.front().window().viewports,
               [](const stereo::Viewport& viewport) { return viewport.screen.fit_aspect; });
}

void Outputs::leave_free(const stereo::Margins& margins) {
    if (room_)
        room_->leave_free(margins);
    if (adapts())
        displays_.front().leave_free(margins);
}

void Outputs::show_aside(float share) {
    if (adapts())
        displays_.front().show_aside(share);
}

/// The stereo mode of a window in the last frame.
stereo::StereoMode Outputs::mode_in(const stereo::Window& window) const {
    const stereo::StereoMode mode = mode_of(window, config_.installation, drawn_.audience.stereo);
    return room_ ? RoomView::shown(mode) : mode;
}

/// Only one picture has the overlay: the room's, else the first window's.
Outputs::Overlay Outputs::overlay_of(std::size_t window, const Overlay& overlay) const {
    return window == 0 && !room_ ? overlay : Overlay();
}

void Outputs::draw_window(stereo::Display& display, const Scene& scene, const Overlay& overlay,
                          bool kept) const {
    ScenePlace place{&display.window(), 0, mode_in(display.window()), kept};
    display.draw(
        drawn_.audience.viewers, place.mode,
        [&](std::span<const render::View> views) {
            scene(place, views);
            ++place.viewport;
        },
        overlay);
}

DrawLoad Outputs::draw(const Audience& audience, Scene scene, const Overlay& overlay) {
    drawn_ = {audience, std::move(scene)};
    lacks_overlay_ = false;
    DrawLoad of_cell;
    const Scene counted = [&](const ScenePlace& place, std::span<const render::View> views) {
        for (const render::View& view : views) {
            of_cell.cells += 1;
            of_cell.pixels += static_cast<double>(view.size.x) * static_cast<double>(view.size.y);
        }
        drawn_.scene(place, views);
    };
    const bool in_windows = shows_windows();
    for (std::size_t i = 0; in_windows && i < displays_.size(); ++i)
        draw_window(displays_[i], counted, overlay_of(i, overlay), config_.pictures.only_kept);
    if (headset_)
        headset_display_->draw(audience.eyes, [&](std::span<const render::View> views) {
            counted(ScenePlace{}, views);
        });
    render::expect_memory(gl(), "drawing a frame");
    end_headset_frame(false);
    if (!in_windows)
        headset_display_->mirror(overlay);
    return of_cell;
}

bool Outputs::draw_part(const Audience& audience, PartPlace& place, const PartScene& scene) {
    const bool whole = draw_part_at(audience, place, scene);
    render::expect_memory(gl(), "drawing a part of a picture");
    gl_.Finish(); // so that its time is known
    return whole;
}

bool Outputs::draw_part_at(const Audience& audience, PartPlace& place, const PartScene& scene) {
    const std::vector<stereo::HeadsetEye>& eyes = audience.eyes;
    const std::size_t windows = shows_windows() ? displays_.size() : 0;
    if (place.window >= windows) {
        place.begins =
            headset_display_->draw_part(eyes, place.begins, [&](std::span<const render::View> all) {
                return scene(ScenePlace{}, all);
            });
        return place.begins;
    }
    stereo::Display& display = displays_[place.window];
    const ScenePlace in_window{&display.window(), place.viewport, display.mode()};
    const bool whole = display.draw_part(
        audience.viewers, place.viewport, place.begins,
        [&](std::span<const render::View> views) { return scene(in_window, views); });
    place.begins = whole;
    if (whole && ++place.viewport == display.window().viewports.size())
        place = {.window = place.window + 1};
    return place.window == windows && eyes.empty();
}

void Outputs::show_parts(const Overlay& overlay) {
    lacks_overlay_ = false;
    if (!drawn_.audience.eyes.empty())
        headset_display_->show_parts();
    end_headset_frame(false);
    if (!shows_windows())
        return headset_display_->mirror(overlay);
    for (std::size_t i = 0; i < displays_.size(); ++i)
        displays_[i].show_parts(overlay_of(i, overlay));
}

void Outputs::begin_mean() {
    for (stereo::Display& display : displays_)
        display.begin_mean();
    render::expect_memory(gl(), "the samples of a picture");
}

void Outputs::end_mean() {
    for (stereo::Display& display : displays_)
        display.end_mean();
}

void Outputs::prepare_mean() {
    if (passes() > 1)
        for (stereo::Display& display : displays_)
            display.prepare_mean();
}

void Outputs::add_to_mean() {
    for (stereo::Display& display : displays_)
        display.add_to_mean();
}

void Outputs::complete_mean() {
    for (stereo::Display& display : displays_)
        display.complete_mean();
}

/// A picture to keep of a settled window is of the window's samples.
stereo::DisplayOptions Outputs::kept_options(glm::ivec2 size, const PictureNote& frame) const {
    stereo::DisplayOptions options = picture_options(gl_, config_, size);
    options.transparent = have_opacity(frame);
    if (is_settled()) {
        options.samples = display_options(gl_, config_).samples;
        options.passes = passes_;
    }
    return options;
}

void Outputs::draw_again(const Audience& audience, const Overlay& overlay) {
    drawn_.audience = audience;
    lacks_overlay_ = false;
    end_headset_frame(true);
    if (!shows_windows())
        return headset_display_->mirror(overlay);
    for (std::size_t i = 0; i < displays_.size(); ++i)
        displays_[i].draw_overlay_again(overlay_of(i, overlay));
}

void Outputs::end_headset_frame(bool again) {
    if (headset_)
        headset_display_->submit(*headset_, drawn_.audience.eyes, again);
}

void Outputs::draw_room(const interaction::InputState& input, const Overlay& overlay) {
    if (!room_)
        return;
    const Audience& audience = drawn_.audience;
    room_->set_panel(audience.panel);
    room_->draw(displays_, audience.viewers, audience.wand, input, overlay);
}

void Outputs::present() {
    render::expect_context(gl_);
    in_flight_.end_frame();
    if (!shows_windows())
        return headset_display_->present();
    for (stereo::Display& display : displays_)
        display.present();
    if (room_)
        room_->present();
}

KeptPictures Outputs::kept_pictures(const PictureNote& frame) {
    lacks_overlay_ = true;
    const auto draw = [this](stereo::Display& display) {
        draw_window(display, drawn_.scene, {}, true);
    };
    const auto options = [this, frame](glm::ivec2 size) { return kept_options(size, frame); };
    return {gl_, windows_, config_, displays_, room_, draw, options, is_settled(), !frame.as_seen};
}

/// The picture to keep of the headset's mirror.
render::Image Outputs::headset_picture(const PictureNote& frame) {
    const std::vector<stereo::HeadsetEye>& eyes = drawn_.audience.eyes;
    const stereo::DisplayOptions options =
        picture_options(gl_, config_, windows_[0].framebuffer_size());
    if (eyes.empty() ||
        (options.samples == display_options(gl_, config_).samples && frame.as_seen)) {
        headset_display_->mirror({});
        return headset_display_->read_window();
    }
    stereo::HeadsetDisplay picture(gl_, windows_.drawing(), windows_[0], config_.openxr.mirror,
                                   options);
    picture.draw(eyes, [&](std::span<const render::View> views) {
        drawn_.scene(ScenePlace{.kept = true}, views);
    });
    picture.mirror({});
    return picture.read_window();
}

PictureNote Outputs::noted(PictureNote frame, const PicturePart& part) const {
    frame.program = kProgram;
    frame.drawn_with = windows_.drawing().description();
    frame.configuration = config_.text;
    frame.part = part;
    frame.size = room_ ? room_->size() : windows_[0].framebuffer_size();
    for (std::size_t i = 0; !room_ && i < displays_.size(); ++i)
        if (windows_.number(i) == part.window)
            frame.size = displays_[i].size();
    const stereo::DisplayOptions options = kept_options(frame.size, frame);
    frame.samples = options.samples;
    frame.passes = options.passes;
    frame.ray = config_.pictures.ray;
    frame.caption = config_.pictures.caption;
    frame.shape = render::name_of(config_.rendering.cell_shape);
    return frame;
}

/// The size that the user has chosen for pictures of a single window; empty: none.
std::optional<glm::ivec2> Outputs::asked_size(const PictureNote& frame) const {
    const interaction::WrittenPictures how = written_in(frame);
    const bool own = how.width > 0 && how.height > 0;
    if (displays_.size() != 1 || (!own && how.scale == 1))
        return std::nullopt;
    const glm::ivec2 size =
        own ? glm::ivec2(how.width, how.height) : size_beside_panel(displays_.front());
    constexpr int kMost = static_cast<int>(interaction::kLargestPicture);
    return glm::clamp(glm::ivec2(glm::round(how.scale * glm::dvec2(size))), 1, kMost);
}

/// Whether pictures to keep are drawn over nothing.
bool Outputs::have_opacity(const PictureNote& frame) const {
    return written_in(frame).background == interaction::WrittenBackground::transparent && !room_ &&
           !headset_;
}

render::Image Outputs::finished(render::Image image, const PictureNote& frame) const {
    image.dpi = written_in(frame).dpi;
    image.opaque = !have_opacity(frame);
    if (!image.opaque)
        render::unmix_black(image);
    return image;
}

void Outputs::set_screenshots(const std::filesystem::path& folder) {
    screenshot_folder_ = folder;
    screenshots_taken_ = last_screenshot(folder);
}

void Outputs::take_screenshots(const PictureNote& frame) {
    const std::string stem = screenshot_name(++screenshots_taken_);
    each_picture(frame,
                 [&](const std::string& suffix, render::Image image, const std::string& note) {
                     write_image(std::move(image),
                                 screenshot_folder_ / fmt::format("{}{}.png", stem, suffix), note);
                 });
}

void Outputs::each_picture(const PictureNote& frame, const TakeNotedPicture& take) {
    const DrawsOnly draws;
    const auto give = [&](const PicturePart& part, const std::string& suffix, render::Image image) {
        take(suffix, finished(std::move(image), frame), text_of(noted(frame, part)));
    };
    if (room_)
        return give({.shows = "room"}, "", kept_pictures(frame).of_room());
    if (!shows_windows())
        return give({.shows = "headset"}, "", headset_picture(frame));
    const PictureNames names = picture_names(config_.installation);
    const KeptPictures kept = kept_pictures(frame);
    const std::optional<glm::ivec2> asked = asked_size(frame);
    for (std::size_t i = 0; i < displays_.size(); ++i) {
        const std::size_t number = windows_.number(i);
        const std::string& suffix = names.windows[number].suffix;
        if (displays_[i].fills() && !asked) {
            kept.take(i, [&](std::size_t, const stereo::Display& display) {
                give({.window = number}, suffix, display.read_window());
            });
            continue;
        }
        // Beside a panel the data are seen in what the panel leaves free: that is the picture.
        PictureNote seen = noted(frame, {.window = number});
        seen.size = asked.value_or(size_beside_panel(displays_[i]));
        if (frame.as_seen && !asked && is_settled() && is_one_eye(displays_[i])) {
            const stereo::Eye eye = stereo::eyes_of(displays_[i].mode()).front();
            take(suffix, finished(displays_[i].read_eye(eye), frame), text_of(seen));
            continue;
        }
        const auto context = stereo::offscreen_beside(windows_.drawing(), seen.size);
        stereo::Display picture(gl_, windows_.drawing(), *context, displays_[i].window(),
                                kept_options(seen.size, frame));
        draw_window(picture, drawn_.scene, {}, true);
        take(suffix, finished(picture.read_window(), frame), text_of(seen));
    }
}

void Outputs::write_image(render::Image image, const std::filesystem::path& path,
                          const std::string& note) {
    pictures_.post([image = std::move(image), path, note] {
        stereo::write_image(image, path, note);
        return "saved " + whole_path(path);
    });
}

} // namespace isochron::app
