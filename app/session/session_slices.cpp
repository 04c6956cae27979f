// The exact picture at rest, which is drawn over several frames beside the one that is shown.
#include "app/session/session.h"

#include "app/frame/stop_watch.h"

#include <algorithm>
#include <utility>

namespace isochron::app {

/// How footprints are chosen in a frame. The frames of a replay are each drawn at once.
Choosing Session::choosing(Waiting waiting) const {
    return waiting == Waiting::never ? Choosing::with_slices : Choosing::by_pace;
}

/// Whether a picture at rest of more cells than a frame can draw is made in slices.
bool Session::may_be_sliced(Waiting waiting) const {
    return choosing(waiting) == Choosing::with_slices && config_.still_budget_ms > 0 &&
           state_.quality == interaction::QualityMode::automatic && !state_.playback.playing;
}

/// Whether a picture at rest differs from the one that is shown in nothing but more detail, and may
/// be made in slices.
bool Session::only_gets_finer(const Picture& now, Waiting waiting) const {
    if (!rests_ || !drawn_ || choosing(waiting) != Choosing::with_slices ||
        now.cells == drawn_->cells || now.cells != scene_.held(Scene::Use::at_rest))
        return false;
    Picture same = now;
    same.cells = drawn_->cells;
    same.footprint = drawn_->footprint;
    same.scale = drawn_->scale;
    return same == drawn_;
}

/// Shows the picture at rest that was made in slices for as long as nothing changes.
void Session::rest_in_slices(Picture& now, Waiting waiting, FrameReport& report) {
    if (!report.in_slices || !drawn_)
        return;
    now.footprint = *report.in_slices;
    const bool shown = now == drawn_;
    if (!shown)
        now.footprint = report.footprint;
    report.footprint = now.footprint;
    report.reason = QualityReason::in_slices;
    report.final = shown && is_finest(waiting);
    if (shown)
        report.expected = std::exchange(report.better, std::nullopt);
}

/// Draws as much of the picture at rest as this frame has time for, and shows it once it is whole,
/// in a cluster: once it is whole in all processes, which show it in the same frame.
void Session::draw_slices(const Picture& now, const Outputs::Overlay& overlay,
                          FrameReport& report) {
    Picture wanted = now;
    wanted.footprint = *report.in_slices;
    if (!slices_ || slices_->picture != wanted)
        slices_.emplace(wanted, quality_.slice_budget());
    SlicePace& pace = slices_->pace;
    pace.begin_frame();
    StopWatch watch;
    while (const std::size_t work = slices_->whole ? 0 : pace.next()) {
        std::size_t done = scene_.prepare_slices(wanted.footprint, work);
        if (done > 0) {
            outputs_.gl().Finish(); // so that its time is known
            pace.took(done, watch.lap());
            continue;
        }
        slices_->whole = outputs_.draw_slice(
            slices_->place, [&](const ScenePlace& place, std::span<const render::View> views) {
                return draw_slice(place, views, work, done);
            });
        pace.took(done, watch.lap());
        if (slices_->whole)
            quality_.learn_slices(wanted.footprint, report.cells, pace.whole());
    }
    slices_whole_ = slices_->whole;
    if (!slices_whole_ || !shows_slices_)
        return outputs_.draw_again(now.audience, overlay);
    outputs_.show_slices(overlay);
    drawn_ = std::move(wanted);
    slices_.reset();
    report.footprint = drawn_->footprint;
    report.redrawn = true;
}

/// Draws the next of: what comes before the cells of a viewport, some of the cells, what comes
/// after them. @param done work that was done, of at most `work` @return whether it was the last
bool Session::draw_slice(const ScenePlace& place, std::span<const render::View> views,
                         std::size_t work, std::size_t& done) {
    SceneSlice slice{.begins = slices_->place.begins, .cells = {slices_->done, 0}, .ends = false};
    const std::size_t all = scene_.work(views.size(), slices_->picture.footprint);
    if (slice.begins) {
        slices_->done = 0;
    } else if (slices_->done < all) {
        done = std::min(work, all - slices_->done);
        slice.cells.count = done;
        slices_->done += done;
    } else {
        slice.ends = true;
    }
    draw_views(place, views, slices_->picture, slice);
    return slice.ends;
}

} // namespace isochron::app
