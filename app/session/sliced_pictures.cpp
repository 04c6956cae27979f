// Pictures that are drawn over several frames beside the one that is shown: the exact one at rest,
// and those that only tell what a footprint would cost.
#include "app/session/session.h"

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
        now.cells == drawn_->cells || now.cells != scene_.cells().held(CellSets::Use::at_rest))
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
        slices_.emplace(wanted);
    if (!slices_->whole) {
        slices_->pace.begin_frame(quality_.slice_budget());
        draw_pieces(*slices_);
    }
    slices_whole_ = slices_->whole;
    if (!slices_whole_ || !shows_slices_)
        return outputs_.draw_again(now.audience, overlay);
    quality_.learn_slices(wanted.footprint, report.cells,
                          frames_->slices_took(slices_->pace.whole()));
    outputs_.show_slices(overlay);
    drawn_ = std::move(wanted);
    slices_.reset();
    report.footprint = drawn_->footprint;
    report.redrawn = true;
}

/// Draws pieces of a picture while this frame has time for them, or until it is whole.
void Session::draw_pieces(Slices& slices) {
    StopWatch watch;
    while (const std::size_t work = slices.whole ? 0 : slices.pace.next()) {
        std::size_t done = scene_.prepare_parts(slices.picture, work);
        if (done > 0) {
            outputs_.gl().Finish(); // so that its time is known
            const Milliseconds time = watch.lap();
            slices.prepared += time;
            slices.pace.took(done, time);
            continue;
        }
        slices.whole = outputs_.draw_slice(
            slices.place, [&](const ScenePlace& place, std::span<const render::View> views) {
                return draw_slice(slices, place, views, work, done);
            });
        slices.pace.took(done, watch.lap());
    }
}

/// Draws the next of: what comes before the cells of a viewport, some of the cells, what comes
/// after them. @param done work that was done, of at most `work` @return whether it was the last
bool Session::draw_slice(Slices& slices, const ScenePlace& place,
                         std::span<const render::View> views, std::size_t work, std::size_t& done) {
    ScenePart slice{.begins = slices.place.begins, .cells = {slices.done, 0}, .ends = false};
    const std::size_t all = scene_.work(slices.picture, views.size());
    if (slice.begins) {
        slices.done = 0;
    } else if (slices.done < all) {
        slice.cells.count = done = std::min(work, all - slices.done);
    } else {
        slice.ends = true;
    }
    slices.done += draw_views(place, views, slices.picture, slice);
    return slice.ends;
}

/// A footprint that might serve moving pictures is drawn where nobody sees it, to find out its
/// time: in the time that frames leave, each piece for the views of its own frame. Where light
/// shines through, every view needs an order of its own: then it is not done.
/// @param frame began with the frame, which is on show now
void Session::measure_unseen(const Picture& now, const StopWatch& frame,
                             const FrameReport& report) {
    const std::optional<render::Footprint> footprint = quality_.unseen();
    const bool opaque =
        std::ranges::all_of(now.isosurfaces, [](const interaction::Isosurface& surface) {
            return surface.opacity >= 1.0f;
        });
    if (!footprint || !opaque || !frames_->alone() || !outputs_.want(now.audience) ||
        now.cells != scene_.cells().shown()) {
        unseen_.reset();
        return;
    }
    if (!unseen_ || unseen_->picture.cells != now.cells ||
        unseen_->picture.footprint != *footprint ||
        unseen_->picture.layout.windows != now.layout.windows)
        unseen_.emplace(now);
    unseen_->picture = now;
    unseen_->picture.footprint = *footprint;
    outputs_.gl().Finish(); // so that the frame's own time is known
    const Milliseconds left = quality_.left_of_frame(frame.time());
    if (!(left.count() > 0))
        return;
    slices_.reset(); // they are drawn in the same place
    unseen_->pace.begin_frame(left);
    draw_pieces(*unseen_);
    if (!unseen_->whole)
        return;
    quality_.learn_slices(*footprint, report.cells, unseen_->pace.whole() - unseen_->prepared);
    unseen_.reset();
}

} // namespace isochron::app
