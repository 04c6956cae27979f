// Draws for a headset, and mirrors its pictures.
#include "stereo/headset_display.h"

#include "render/gl/driver.h"
#include "stereo/views_in_target.h"

#include <glm/common.hpp>

namespace isochron::stereo {

HeadsetDisplay::HeadsetDisplay(const render::Gl& gl, GlContext& drawing, GlContext& window,
                               Mirror mirror, const DisplayOptions& options)
    : gl_(&gl), in_software_(render::draws_in_software(gl)), window_(&window), mirror_(mirror),
      options_(options), presenter_(gl, drawing, window),
      window_picture_(gl, glm::max(window.framebuffer_size(), glm::ivec2(1))) {
    window_picture_.clear({0, 0, 0, 1});
}

/// Also says where the eyes' pictures lie, and how large both are.
std::vector<render::View> HeadsetDisplay::views_in_target(std::span<const HeadsetEye> eyes) {
    std::vector<render::View> views;
    whole_ = glm::ivec2(0);
    for (std::size_t i = 0; i < eyes.size(); ++i) {
        parts_[i] = {{whole_.x, 0}, eyes[i].pixels};
        views.push_back(view_of(eyes[i], options_.near_plane, options_.far_plane));
        views.back().corner = parts_[i].corner;
        whole_ = {whole_.x + eyes[i].pixels.x, glm::max(whole_.y, eyes[i].pixels.y)};
    }
    return views;
}

void HeadsetDisplay::draw(std::span<const HeadsetEye> eyes, const Scene& scene) {
    if (eyes.size() != parts_.size())
        return;
    const std::vector<render::View> views = views_in_target(eyes);
    draw_views(*gl_, target_, whole_, options_, views, scene);
    // When another framebuffer is bound, Mesa 22.3's llvmpipe copies a texture of the same format
    // without waiting for unfinished drawing into it.
    if (in_software_)
        gl_->Finish();
}

bool HeadsetDisplay::draw_part(std::span<const HeadsetEye> eyes, bool begins,
                               const DrawPart& scene) {
    const std::vector<render::View> views = views_in_target(eyes);
    return draw_views_on(*gl_, next_, whole_, options_, views, begins, scene);
}

void HeadsetDisplay::submit(Headset& headset, std::span<const HeadsetEye> eyes, bool again) {
    if (eyes.size() != parts_.size())
        return headset.end_frame(nullptr, false);
    const HeadsetPictures pictures{HeadsetPicture{&*target_, parts_[0].corner},
                                   HeadsetPicture{&*target_, parts_[1].corner}};
    headset.end_frame(&pictures, again);
}

void HeadsetDisplay::cover(const Part& picture, glm::ivec2 corner, glm::ivec2 size) const {
    if (!target_)
        return;
    const glm::vec2 whole(picture.size), shape(size);
    const float scale = glm::min(whole.x / shape.x, whole.y / shape.y);
    const glm::ivec2 part = glm::max(glm::ivec2(scale * shape), glm::ivec2(1));
    const glm::ivec2 from = picture.corner + (picture.size - part) / 2, to = from + part;
    const glm::ivec2 end = corner + size;
    gl_->BlitNamedFramebuffer(target_->framebuffer(), window_picture_.framebuffer(), from.x, from.y,
                              to.x, to.y, corner.x, corner.y, end.x, end.y, GL_COLOR_BUFFER_BIT,
                              GL_LINEAR);
}

void HeadsetDisplay::mirror(const Overlay& overlay) {
    const glm::ivec2 size = window_->framebuffer_size();
    if (size.x < 2 || size.y < 1)
        return; // minimized
    window_picture_.resize(size);
    window_picture_.clear({0, 0, 0, 1});
    gl_->Disable(GL_SCISSOR_TEST);
    const glm::ivec2 half(size.x / 2, size.y);
    if (mirror_ == Mirror::both) {
        cover(part(Eye::left), {0, 0}, half);
        cover(part(Eye::right), {size.x - half.x, 0}, half);
    } else if (mirror_ != Mirror::none) {
        cover(part(mirror_ == Mirror::left ? Eye::left : Eye::right), {0, 0}, size);
    }
    window_picture_.bind();
    if (overlay)
        overlay(size);
}

void HeadsetDisplay::present() {
    presenter_.present(window_picture_, nullptr);
}

render::Image HeadsetDisplay::read_eye(Eye eye) const {
    if (!target_)
        throw render::Error("headset: the {} eye's picture asked for, none was drawn",
                            name_of(eye));
    return target_->read(part(eye).corner, part(eye).size);
}

} // namespace isochron::stereo
