// Pictures that are drawn over several frames beside the one that is shown.
#include "app/session/partial_pictures.h"

#include "app/session/kept/moved_picture.h"

#include <algorithm>
#include <utility>

namespace isochron::app {
namespace {

bool are_opaque(const Picture& picture) {
    return std::ranges::all_of(picture.isosurfaces, [](const interaction::Isosurface& surface) {
        return surface.opacity >= 1.0f;
    });
}

} // namespace

std::optional<Picture> PartialPictures::draw(const Frame& frame, const Picture& now,
                                             const Outputs::Overlay& overlay) {
    Picture wanted = now;
    wanted.footprint = *frame.plan.state.in_parts();
    wanted.mesh_level = 0;
    wanted.moved = false;
    if (!parts_ || !same_cells(parts_->picture, wanted))
        parts_.emplace(wanted);
    outputs_.leave_free(now.layout.free);
    // What lies over the cells is drawn last. Where it is drawn already, the next frame draws it anew.
    if (parts_->place.window == 0 && parts_->place.viewport == 0)
        parts_->picture = wanted;
    if (!parts_->whole) {
        parts_->pace.begin_frame(quality_.part_budget());
        draw_pieces(*parts_);
    }
    whole_ = parts_->whole;
    if (!whole_ || !frame.plan.state.parts_are_whole())
        return std::nullopt;
    quality_.learn_parts(wanted.footprint, frame.report.cells,
                         frame.sharing.parts_took(parts_->pace.whole()));
    outputs_.show_parts(overlay);
    const Picture shown = std::move(parts_->picture);
    parts_.reset();
    return shown;
}

void PartialPictures::give_up_others(const Picture& drawn) {
    Picture same = drawn;
    same.resolution = same.mesh_level = 0;
    same.moved = false;
    if (parts_)
        same.footprint = parts_->picture.footprint;
    if (parts_ && !same_cells(parts_->picture, same))
        parts_.reset();
}

/// Draws pieces of a picture while this frame has time for them, or until it is whole.
void PartialPictures::draw_pieces(Parts& parts) {
    StopWatch watch;
    while (const std::size_t work = parts.whole ? 0 : parts.pace.next()) {
        std::size_t done = scene_.prepare_parts(parts.picture, work);
        if (done > 0) {
            outputs_.gl().Finish(); // so that its time is known
            const Milliseconds time = watch.lap();
            parts.prepared += time;
            parts.pace.took(done, time);
            continue;
        }
        parts.whole =
            outputs_.draw_part(parts.picture.audience, parts.place,
                               [&](const ScenePlace&, std::span<const render::View> views) {
                                   return draw_part(parts, views, work, done);
                               });
        parts.pace.took(done, watch.lap());
    }
}

/// Draws the next part of a viewport: what comes before the cells, some of the cells, or what comes
/// after them. @param done work that was done, of at most `work` @return whether it was the last
bool PartialPictures::draw_part(Parts& parts, std::span<const render::View> views, std::size_t work,
                                std::size_t& done) {
    ScenePart part{
        .begins = parts.place.begins, .cells = {parts.done, 0}, .ends = false, .keeps = true};
    const std::size_t all = scene_.work(parts.picture, views.size());
    if (part.begins) {
        parts.done = 0;
    } else if (parts.done < all) {
        part.cells.count = done = std::min(work, all - parts.done);
    } else {
        part.ends = true;
    }
    parts.done += scene_.draw(parts.picture, views, part);
    return part.ends;
}

void PartialPictures::draw_ahead(const Frame& frame, const Picture& now, const StopWatch& begun) {
    Milliseconds left{0};
    if (frame.plan.state.draws_ahead() && frame.sharing.alone() && outputs_.want(now.audience) &&
        outputs_.viewports(now.audience) == 1 && now.audience.eyes.empty() && are_opaque(now)) {
        outputs_.gl().Finish(); // so that the frame's own time is known
        left = quality_.left_of_frame(begun.time());
    } else {
        ahead_.reset();
    }
    if (!(left.count() > 0))
        return;
    CellSets& sets = scene_.cells();
    const bool rested = sets.draws_at_rest();
    sets.draw_at_rest(true, frame.report.asked);
    draw_ahead_within(left, frame, now);
    sets.draw_at_rest(rested, frame.report.asked);
}

/// Of the set with the most detail that is there, which is the drawn one meanwhile.
void PartialPictures::draw_ahead_within(Milliseconds left, const Frame& frame, const Picture& now) {
    const CellSets& sets = scene_.cells();
    if (!sets.is_complete() || !sets.footprints().has(render::Footprint::surface))
        return ahead_.reset();
    if (!ahead_ || ahead_->picture.cells != sets.shown() || ahead_->picture.layout != now.layout ||
        !may_be_moved(ahead_->picture, now, frame.report.asked)) {
        ahead_.emplace(now);
        ahead_->picture.cells = sets.shown();
        ahead_->picture.footprint = render::Footprint::surface;
        ahead_->picture.resolution = ahead_->picture.mesh_level = 0;
        ahead_->picture.moved = false;
    }
    parts_.reset(); // they are drawn in the same place
    ahead_->pace.begin_frame(left);
    draw_pieces(*ahead_);
    if (!ahead_->whole)
        return;
    quality_.learn_parts(render::Footprint::surface, sets.shown()->cells(),
                         ahead_->pace.whole() - ahead_->prepared);
    ahead_.reset();
}

} // namespace isochron::app
