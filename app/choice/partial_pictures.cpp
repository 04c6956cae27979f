// Pictures that are drawn over several frames beside the one that is shown.
#include "app/choice/partial_pictures.h"

#include "app/choice/moved_picture.h"

#include <algorithm>
#include <utility>

namespace isochron::app {
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
        parts_->draw(scene_, outputs_, quality_.part_budget());
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

void PartialPictures::draw_ahead(const Frame& frame, const Picture& now, const StopWatch& begun) {
    Milliseconds left{0};
    if (frame.plan.state.draws_ahead() && frame.sharing.alone() && outputs_.want(now.audience) &&
        outputs_.viewports(now.audience) == 1 && now.audience.eyes.empty() &&
        !interaction::any_is(now.isosurfaces, true)) {
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

/// Draws ahead the set with the most detail that is there, which is the drawn one meanwhile.
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
    ahead_->draw(scene_, outputs_, left);
    if (!ahead_->whole)
        return;
    quality_.learn_parts(render::Footprint::surface, sets.shown()->cells(),
                         ahead_->pace.whole() - ahead_->prepared);
    ahead_.reset();
}

} // namespace isochron::app
