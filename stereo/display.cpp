// Draws the eyes' pictures, and composes them in the window.
#include "stereo/display.h"

#include "stereo/views_in_target.h"

#include <glm/common.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>

namespace isochron::stereo {
namespace {

glm::ivec2 at_least_one(glm::ivec2 size) {
    return glm::max(size, glm::ivec2(1));
}

/// Corner of an eye's picture in the target of its viewport. The second picture is beside the
/// first; if pictures are wider than high it is above, to keep the target's sides within GL's
/// limits.
glm::ivec2 corner_in_target(std::size_t number, glm::ivec2 size) {
    const glm::ivec2 next = size.x > size.y ? glm::ivec2(0, size.y) : glm::ivec2(size.x, 0);
    return static_cast<int>(number) * next;
}

/// Half a turn of a picture in its plane, of clip space.
const glm::mat4 kTurned(glm::vec4(-1, 0, 0, 0), glm::vec4(0, -1, 0, 0), glm::vec4(0, 0, 1, 0),
                        glm::vec4(0, 0, 0, 1));

constexpr glm::vec4 kBlack{0.0f, 0.0f, 0.0f, 1.0f};

} // namespace

Display::Display(const render::Gl& gl, GlContext& drawing, GlContext& context, Window window,
                 const DisplayOptions& options)
    : gl_(&gl), context_(&context), window_(std::move(window)), options_(options), multiplex_(gl),
      presenter_(gl, drawing, context), composed_(gl, at_least_one(context.framebuffer_size())),
      targets_(window_.viewports.size()), next_(window_.viewports.size()),
      sums_(window_.viewports.size()) {
    composed_.clear(kBlack);
}

void Display::draw(std::span<const ViewerPose> viewers, StereoMode mode, const Scene& scene,
                   const Overlay& overlay) {
    const glm::ivec2 size = context_->framebuffer_size();
    if (size.x < 1 || size.y < 1)
        return;
    mode_ = mode;
    margins_ = next_margins_;
    end_mean();
    composed_.resize(size);
    if (upright(mode) != StereoMode::quadbuffer)
        right_buffer_.reset();
    else if (right_buffer_)
        right_buffer_->resize(size);
    else
        right_buffer_.emplace(*gl_, size);
    for (std::size_t i = 0; i < targets_.size(); ++i)
        draw_viewport(targets_[i], i, viewers[window_.viewports[i].viewer], scene);
    if (options_.passes > 1)
        draw_mean(viewers, scene);
    compose(overlay);
}

render::View Display::view_in(const Viewport& viewport, const ViewerPose& viewer, Eye eye) const {
    const glm::ivec2 size = region_of(viewport, place_of(eye, mode_)).size;
    return viewer.parallel > 0 && viewport.screen.fit_aspect
               ? parallel_view_of(viewport.screen, viewer.head, viewer.parallel, options_.far_plane,
                                  size)
               : view_of(viewport.screen, viewer.head, eye, viewer.eyes, options_.near_plane,
                         options_.far_plane, size);
}

std::vector<render::View> Display::views_in_target(std::size_t number,
                                                   const ViewerPose& viewer) const {
    std::vector<render::View> views;
    for (const Eye eye : eyes_of(mode_)) {
        views.push_back(view_in(window_.viewports[number], viewer, eye));
        views.back().corner = corner_in_target(views.size() - 1, views.back().size);
        if (in_mean() > 0)
            views.back() = views.back().moved_by(render::sample_place(
                in_mean(), 1.0f / std::sqrt(static_cast<float>(options_.samples))));
    }
    return views;
}

bool Display::draw_part(std::span<const ViewerPose> viewers, std::size_t viewport, bool begins,
                        const DrawPart& scene) {
    if (!targets_[viewport])
        return true; // the window is minimized
    std::swap(margins_, next_margins_);
    const std::vector<render::View> views =
        views_in_target(viewport, viewers[window_.viewports[viewport].viewer]);
    std::swap(margins_, next_margins_);
    return draw_views_on(*gl_, next_[viewport], views.back().corner + views.back().size, options_,
                         views, begins, scene);
}

void Display::show_parts(const Overlay& overlay) {
    for (std::size_t i = 0; i < targets_.size(); ++i)
        if (next_[i])
            std::swap(targets_[i], next_[i]);
    margins_ = next_margins_;
    draw_overlay_again(overlay);
}

void Display::begin_mean() {
    for (std::size_t i = 0; i < targets_.size(); ++i) {
        if (!targets_[i])
            return end_mean(); // the window is minimized
        if (!sums_[i])
            sums_[i].emplace(*gl_);
        sums_[i]->begin(*targets_[i]);
    }
    in_mean_ = 1;
}

void Display::prepare_mean() {
    const render::RenderTarget pixel(*gl_, glm::ivec2(1));
    for (std::optional<render::SampleSum>& sum : sums_)
        if (!sum)
            sum.emplace(*gl_).begin(pixel);
}

void Display::add_to_mean() {
    for (std::size_t i = 0; i < targets_.size(); ++i)
        sums_[i]->add(*next_[i]);
    ++in_mean_;
}

void Display::complete_mean() {
    for (std::size_t i = 0; i < targets_.size(); ++i)
        sums_[i]->write_mean(*next_[i]);
}

/// Goes on from the pictures that are drawn, the first of the mean.
void Display::draw_mean(std::span<const ViewerPose> viewers, const Scene& scene) {
    begin_mean();
    while (in_mean() < options_.passes) {
        for (std::size_t i = 0; i < targets_.size(); ++i)
            draw_viewport(next_[i], i, viewers[window_.viewports[i].viewer], scene);
        add_to_mean();
    }
    complete_mean();
    for (std::size_t i = 0; i < targets_.size(); ++i)
        std::swap(targets_[i], next_[i]);
    end_mean();
}

void Display::draw_viewport(std::optional<render::RenderTarget>& target, std::size_t number,
                            const ViewerPose& viewer, const Scene& scene) {
    const std::vector<render::View> views = views_in_target(number, viewer);
    draw_views(*gl_, target, views.back().corner + views.back().size, options_, views, scene);
}

std::vector<render::View> Display::views_in_window(std::span<const ViewerPose> viewers) const {
    std::vector<render::View> views;
    if (Multiplex::shows(mode_) || right_buffer_)
        return views;
    for (const Viewport& viewport : window_.viewports)
        for (const Eye eye : eyes_of(mode_)) {
            views.push_back(view_in(viewport, viewers[viewport.viewer], eye));
            views.back().corner = region_of(viewport, place_of(eye, mode_)).corner;
            if (viewport.upside_down)
                views.back().clip_from_eye = kTurned * views.back().clip_from_eye;
        }
    return views;
}

void Display::draw_overlay_again(const Overlay& overlay) {
    const glm::ivec2 size = context_->framebuffer_size();
    if (size == composed_.size())
        compose(overlay);
}

Display::Region Display::region_of(const Viewport& viewport, Eye place) const {
    glm::ivec2 corner(0), size = composed_.size();
    if (upright(mode_) == StereoMode::side_by_side) {
        const int half = size.x / 2;
        corner.x = place == Eye::left ? 0 : size.x - half;
        size.x = half;
    } else if (upright(mode_) == StereoMode::top_bottom) {
        const int half = size.y / 2;
        corner.y = place == Eye::left ? size.y - half : 0;
        size.y = half;
    }
    const int left = std::clamp(margins_.left, 0, size.x - 1);
    const int bottom = std::clamp(margins_.bottom, 0, size.y - 1);
    corner += glm::ivec2(left, bottom);
    size -= glm::ivec2(left, bottom);
    size.y -= std::clamp(margins_.top, 0, size.y - 1);
    // Round both edges, so that neighboring viewports neither overlap nor leave a gap.
    const glm::ivec2 low(glm::round(viewport.position * glm::vec2(size)));
    const glm::ivec2 high(glm::round((viewport.position + viewport.size) * glm::vec2(size)));
    return {corner + low, at_least_one(high - low)};
}

bool Display::fills_window() const {
    if (targets_.size() != 1)
        return false;
    int area = 0;
    for (const Eye eye : eyes_of(mode_)) {
        const glm::ivec2 covered = region_of(window_.viewports.front(), eye).size;
        area += covered.x * covered.y;
    }
    if (Multiplex::shows(mode_) || right_buffer_)
        area /= 2; // both eyes have the same region
    return area == composed_.size().x * composed_.size().y;
}

std::optional<interaction::Pose> Display::ray_at(std::span<const ViewerPose> viewers,
                                                 glm::vec2 at) const {
    const bool shared = Multiplex::shows(mode_) || right_buffer_.has_value();
    for (const Viewport& viewport : window_.viewports)
        for (const Eye place : eyes_of(mode_)) {
            const Region region = region_of(viewport, place);
            glm::vec2 local = (at * glm::vec2(composed_.size()) - glm::vec2(region.corner)) /
                              glm::vec2(region.size);
            if (viewport.upside_down)
                local = 1.0f - local;
            if (!(local.x >= 0 && local.x <= 1 && local.y >= 0 && local.y <= 1))
                continue;
            const ViewerPose& viewer = viewers[viewport.viewer];
            if (viewer.parallel > 0 && viewport.screen.fit_aspect)
                return parallel_ray_through(viewport.screen, viewer.head, viewer.parallel,
                                            region.size, local);
            return ray_through(viewport.screen, viewer.head,
                               shared ? Eye::center : place_of(place, mode_), viewer.eyes,
                               region.size, local);
        }
    return std::nullopt;
}

void Display::compose(const Overlay& overlay) {
    compose_into(composed_, Eye::left);
    if (right_buffer_)
        compose_into(*right_buffer_, Eye::right);
    if (!overlay)
        return;
    composed_.bind();
    overlay(composed_.size());
    if (right_buffer_) {
        right_buffer_->bind();
        overlay(right_buffer_->size());
    }
}

void Display::compose_into(const render::RenderTarget& target, Eye buffer) const {
    // Where a panel has left, the picture still lies beside its place for a moment.
    const bool moves = margins_ != next_margins_;
    // In software GL a clear costs as much as a copy, so skip it if nothing of it would show.
    if (!fills_window())
        target.clear(moves ? glm::vec4(options_.background, 1.0f) : kBlack);
    gl_->Disable(GL_SCISSOR_TEST);
    for (std::size_t i = 0; i < targets_.size(); ++i) {
        const Viewport& viewport = window_.viewports[i];
        if (Multiplex::shows(mode_)) {
            const Region region = region_of(viewport, Eye::left);
            target.bind();
            gl_->Viewport(region.corner.x, region.corner.y, region.size.x, region.size.y);
            multiplex_.draw(shown_at(Eye::left, i), shown_at(Eye::right, i), mode_, region.corner,
                            target.size().y, viewport.upside_down);
            continue;
        }
        for (const Eye place : right_buffer_ ? std::vector{buffer} : eyes_of(mode_)) {
            const Region region = region_of(viewport, place);
            glm::ivec2 begin = region.corner, end = region.corner + region.size;
            if (viewport.upside_down)
                std::swap(begin, end); // mirrored in both axes
            const EyePicture eye = shown_at(place, i);
            const glm::ivec2 from = eye.corner, to = eye.corner + eye.size;
            gl_->BlitNamedFramebuffer(eye.target->framebuffer(), target.framebuffer(), from.x,
                                      from.y, to.x, to.y, begin.x, begin.y, end.x, end.y,
                                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
        }
    }
}

void Display::present() {
    presenter_.present(composed_, right_buffer_ ? &*right_buffer_ : nullptr);
}

EyePicture Display::shown_at(Eye place, std::size_t viewport) const {
    return eye_picture(place_of(place, mode_), viewport);
}

EyePicture Display::eye_picture(Eye eye, std::size_t viewport) const {
    if (viewport >= targets_.size())
        throw render::Error("window {}: viewport {} asked for, there are {}", window_.name,
                            viewport, targets_.size());
    const std::vector<Eye> drawn = eyes_of(mode_);
    const auto found = std::ranges::find(drawn, eye);
    if (found == drawn.end() || !targets_[viewport])
        throw render::Error("window {}: the {} eye's picture asked for, mode {} does not draw it",
                            window_.name, name_of(eye), stereo::name_of(mode_));
    const glm::ivec2 size = region_of(window_.viewports[viewport], place_of(eye, mode_)).size;
    const auto number = static_cast<std::size_t>(found - drawn.begin());
    return {&*targets_[viewport], corner_in_target(number, size), size};
}

glm::ivec2 Display::eye_size(std::size_t viewport) const {
    return eye_picture(eyes_of(mode_).front(), viewport).size;
}

render::Image Display::read_right_buffer() const {
    if (!right_buffer_)
        throw render::Error("window {}: the right buffer asked for, mode {} has none", window_.name,
                            stereo::name_of(mode_));
    return right_buffer_->read();
}

render::Image Display::read_eye(Eye eye, std::size_t viewport) const {
    const EyePicture picture = eye_picture(eye, viewport);
    return picture.target->read(picture.corner, picture.size);
}

} // namespace isochron::stereo
