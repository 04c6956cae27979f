// What the first picture does not need: drawn once beside the frames, on another thread first.
#include "app/session/preparation.h"

#include "app/scene/cell_warm_up.h"
#include "stereo/views_in_target.h"

#include <exception>
#include <utility>

namespace isochron::app {

Preparation::Preparation(const render::Gl& gl, Scene& scene, Target target,
                         std::unique_ptr<stereo::GlContext> beside)
    : gl_(gl), scene_(scene), target_(std::move(target)), drawing_(scene.cell_drawing()),
      ways_(scene.ways_left()), beside_(std::move(beside)), ahead_(beside_ ? 0 : ways_.size()) {
    if (beside_)
        thread_ = std::jthread([this](const std::stop_token& stop) { draw_ahead(stop); });
}

Preparation::~Preparation() {
    thread_.request_stop();
    if (thread_.joinable())
        thread_.join();
}

void Preparation::set_wake(std::function<void()> wake) {
    const std::lock_guard lock(mutex_);
    wake_ = std::move(wake);
}

void Preparation::through_with(std::size_t ways) {
    ahead_ = ways;
    const std::lock_guard lock(mutex_);
    if (wake_)
        wake_();
}

void Preparation::draw_ahead(const std::stop_token& stop) {
    try {
        beside_->make_current();
        const render::Gl gl(beside_->loader(), gl_.drawn_by);
        const CellWarmUp warm_up(gl, drawing_);
        render::CellPass cells(gl, drawing_.shapes, drawing_.prelude);
        MovingCells moving(gl, drawing_.grid);
        std::optional<render::RenderTarget> picture;
        for (std::size_t i = 0; i < ways_.size() && !stop.stop_requested(); ++i) {
            stereo::draw_views(gl, picture, target_.size, target_.options, target_.views,
                               [&](std::span<const render::View> views) {
                                   warm_up.draw(ways_[i], cells, moving, views, drawing_);
                               });
            gl.Finish();
            through_with(i + 1);
        }
    } catch (const std::exception&) { // then the session's context does all of it
    }
    beside_->leave();
    through_with(ways_.size());
}

bool Preparation::advance() {
    if (next_ >= ahead_)
        return false;
    stereo::draw_views(
        gl_, picture_, target_.size, target_.options, target_.views,
        [&](std::span<const render::View> views) { scene_.prepare(ways_[next_], views); });
    ++next_;
    return true;
}

} // namespace isochron::app
