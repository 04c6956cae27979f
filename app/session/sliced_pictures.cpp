// Pictures that are drawn over several frames beside the one that is shown.
#include "app/session/sliced_pictures.h"

#include <algorithm>
#include <utility>

namespace isochron::app {

std::optional<Picture> SlicedPictures::draw(const Frame& frame, const Picture& now,
                                            const Outputs::Overlay& overlay) {
    Picture wanted = now;
    wanted.footprint = *frame.plan.in_slices;
    if (!slices_ || slices_->picture != wanted)
        slices_.emplace(wanted);
    if (!slices_->whole) {
        slices_->pace.begin_frame(quality_.slice_budget());
        draw_pieces(*slices_);
    }
    whole_ = slices_->whole;
    if (!whole_ || !frame.plan.shows_slices)
        return std::nullopt;
    quality_.learn_slices(wanted.footprint, frame.report.cells,
                          frame.sharing.slices_took(slices_->pace.whole()));
    outputs_.show_slices(overlay);
    slices_.reset();
    return wanted;
}

/// Draws pieces of a picture while this frame has time for them, or until it is whole.
void SlicedPictures::draw_pieces(Slices& slices) {
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
            slices.place, [&](const ScenePlace&, std::span<const render::View> views) {
                return draw_slice(slices, views, work, done);
            });
        slices.pace.took(done, watch.lap());
    }
}

/// Draws the next of: what comes before the cells of a viewport, some of the cells, what comes
/// after them. @param done work that was done, of at most `work` @return whether it was the last
bool SlicedPictures::draw_slice(Slices& slices, std::span<const render::View> views,
                                std::size_t work, std::size_t& done) {
    ScenePart part{.begins = slices.place.begins, .cells = {slices.done, 0}, .ends = false};
    const std::size_t all = scene_.work(slices.picture, views.size());
    if (part.begins) {
        slices.done = 0;
    } else if (slices.done < all) {
        part.cells.count = done = std::min(work, all - slices.done);
    } else {
        part.ends = true;
    }
    slices.done += scene_.draw(slices.picture, views, part);
    return part.ends;
}

void SlicedPictures::measure_unseen(const Frame& frame, const Picture& now,
                                    const StopWatch& begun) {
    const std::optional<render::Footprint> footprint = frame.plan.unseen;
    const bool opaque =
        std::ranges::all_of(now.isosurfaces, [](const interaction::Isosurface& surface) {
            return surface.opacity >= 1.0f;
        });
    if (!footprint || !opaque || !frame.sharing.alone() || !outputs_.want(now.audience) ||
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
    const Milliseconds left = quality_.left_of_frame(begun.time());
    if (!(left.count() > 0))
        return;
    slices_.reset(); // they are drawn in the same place
    unseen_->pace.begin_frame(left);
    draw_pieces(*unseen_);
    if (!unseen_->whole)
        return;
    quality_.learn_slices(*footprint, frame.report.cells,
                          unseen_->pace.whole() - unseen_->prepared);
    unseen_.reset();
}

} // namespace isochron::app
