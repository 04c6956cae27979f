// Which cells a session asks for, and how they come to the GPU.
#include "app/session/session.h"

#include "app/frame/stop_watch.h"

#include <bit>

namespace isochron::app {
namespace {

CellSets::Use use_of(const index::ExtractionPtr& set) {
    return set && set->query.detail.at_rest ? CellSets::Use::at_rest : CellSets::Use::always;
}

} // namespace

void Session::request_cells(Waiting waiting) {
    index::SurfacesQuery query = surfaces();
    query.mesh_room = mesh_wanted_ ? config_.mesh_room() : 0;
    // Nothing is chosen before the first frame, which does not ask for all cells of a large volume.
    if (waiting == Waiting::never && config_.level_of_detail && !details_.small() &&
        detail_.most_cells == 0)
        detail_.most_cells = DetailChoice::kAtFirst;
    query.detail = detail_;
    index::Request request{frames_->ask(query, waiting), std::nullopt};
    const auto steps = static_cast<std::uint32_t>(this->steps());
    if (state_.playback.playing && steps > 1) {
        const bool reverse = state_.playback.reverse;
        request.ahead = index::StepsAhead{(request.query.step + (reverse ? steps - 1 : 1)) % steps,
                                          steps, reverse};
    }
    extractor_.request(request);
}

void Session::take_newest_cells(Waiting waiting, FrameReport& report) {
    const render::UploadCount before = scene_.cells().uploaded();
    StopWatch watch;
    if (waiting == Waiting::for_cells) {
        scene_.cells().send_whole();
        extractor_.wait();
        report.wait = watch.lap();
    }
    CellsInFrame cells = frames_->cells(extractor_, scene_.cells().shown(), waiting);
    const bool in_motion = waiting == Waiting::never && report.pace == interaction::Pace::moving;
    const auto volume = in_motion ? render::SendVolume::never : render::SendVolume::with_cells;
    if (cells.show && !waits_its_turn(*cells.show) && !comes_too_late(*cells.show, waiting))
        scene_.cells().upload(*cells.show, volume, use_of(*cells.show));
    // A replay uploads all cells that were asked for in one frame, whatever the upload budget.
    while (waiting == Waiting::for_cells && *cells.show &&
           scene_.cells().held(use_of(*cells.show)) != *cells.show) {
        scene_.cells().upload(*cells.show, render::SendVolume::with_cells, use_of(*cells.show));
        if (const std::string refusal = scene_.cells().refusal(*cells.show); !refusal.empty()) {
            if (!give_way(*cells.show))
                throw render::Error(refusal);
            request_cells(waiting);
            extractor_.wait();
            cells = frames_->cells(extractor_, scene_.cells().shown(), waiting);
        }
    }
    scene_.cells().draw_at_rest(!in_motion && !is_half_sent(), surfaces());
    if (cells.show)
        say_refused(*cells.show, report);
    if (cells.stage && scene_.cells().stage(cells.stage, use_of(cells.stage)))
        frames_->staged();
    if (!scene_.cells().is_complete()) // the picture has not come to rest
        report.pace = interaction::Pace::moving;
    report.upload = watch.lap();
    report.uploaded = scene_.cells().uploaded().since(before);
    report_cells(report);
}

void Session::report_cells(FrameReport& report) const {
    const index::ExtractionPtr& shown = scene_.cells().shown();
    if (!shown)
        return;
    report.shown = shown->query.of_cells();
    report.cells = shown->cells();
    report.coarsest = shown->coarse() ? std::ranges::max(shown->detail) : 0;
    report.finest = shown->coarse() ? std::ranges::min(shown->detail) : 0;
    for (const CellSets::Use use : {CellSets::Use::at_rest, CellSets::Use::always})
        if (const index::ExtractionPtr& set = scene_.cells().held(use);
            set && set->volume_cells && set->query.of_cells() == shown->query.of_cells())
            report.volume_cells = set->volume_cells;
    report.candidates = shown->candidates();
    report.reused = shown->reused();
    report.search = shown->search_time();
    report.gather = shown->gather_time;
}

/// Whether the set for pictures at rest lacks its volume, and the one for moving pictures shows the
/// same: until then the finer one would be drawn in one frame, as a moving picture is.
bool Session::is_half_sent() const {
    const index::ExtractionPtr& moving = scene_.cells().held(CellSets::Use::always);
    return captures_.wanted() == 0 && moving && moving->query.of_cells() == surfaces() &&
           !scene_.cells().is_complete(CellSets::Use::at_rest);
}

/// Whether a set takes so much longer to draw than the one at rest that is still being drawn in
/// slices that this one is to be seen first.
bool Session::waits_its_turn(const index::ExtractionPtr& set) const {
    constexpr std::size_t kManyMore = 8;
    const index::ExtractionPtr& resting = scene_.cells().held(CellSets::Use::at_rest);
    return set && resting && all_at_rest_ && set != resting && set->query.detail.at_rest &&
           resting->query.of_cells() == set->query.of_cells() && drawn_ &&
           drawn_->cells != resting && set->cells() > kManyMore * resting->cells();
}

/// Whether a set for moving pictures, asked for before the picture came to rest, has fewer cells than
/// the one that is there: a picture at rest only gets better.
bool Session::comes_too_late(const index::ExtractionPtr& set, Waiting waiting) const {
    const index::ExtractionPtr& moving = scene_.cells().held(CellSets::Use::always);
    return waiting == Waiting::never && rests_ && set && moving && !set->query.detail.at_rest &&
           set->query.of_cells() == moving->query.of_cells() &&
           set->query.detail.most_cells < moving->query.detail.most_cells;
}

/// Whether a set that was asked for is not on the GPU yet.
bool Session::set_comes() const {
    if (extractor_.busy())
        return true;
    const index::ExtractionPtr newest = extractor_.newest();
    return newest && newest != refused_ && newest != scene_.cells().held(use_of(newest));
}

/// Asks for fewer cells from now on, as these could not be shown. @return false if there is nothing
/// coarser
bool Session::give_way(const index::ExtractionPtr& set) {
    const std::uint64_t before = details_.most();
    details_.limit(std::min<std::uint64_t>(set->cells(), before) / 2);
    detail_.most_cells =
        std::min(detail_.most_cells == 0 ? before : detail_.most_cells, details_.most());
    return details_.most() < before;
}

/// Says once, in one line, that a set is too large to be shown, and asks for fewer cells.
void Session::say_refused(const index::ExtractionPtr& set, FrameReport& report) {
    report.refused = scene_.cells().refusal(set);
    if (report.refused.empty()) {
        refused_ = nullptr;
    } else if (set != refused_) { // which may be refused with the same words as the last one
        show_messages({report.refused});
        give_way(set);
        refused_ = set;
    }
}

/// Whether no finer cells than those that are drawn will come for this picture.
bool Session::is_finest(Waiting waiting) const {
    const index::ExtractionPtr& shown = scene_.cells().shown();
    return waiting != Waiting::never || !shown || !shown->coarse() ||
           (shown->query.detail == detail_ && detail_.at_rest);
}

/// The set for pictures at rest takes longer to draw than a frame may. So it is drawn once nothing
/// has changed for a while: a head that sways is shown the set for motion.
void Session::choose_set(Picture& now, Waiting waiting, FrameReport& report) {
    Picture same = now;
    if (drawn_) {
        same.cells = drawn_->cells;
        same.footprint = drawn_->footprint;
        same.scale = drawn_->scale;
    }
    if (same != drawn_) {
        constant_since_ = report.time;
        cells_at_first_ = 0;
        all_at_rest_ = false;
    }
    rests_ = waiting != Waiting::never || captures_.wanted() > 0 ||
             report.time - constant_since_ >= FrameQuality::kStillAfter;
    const index::ExtractionPtr& moving = scene_.cells().held(CellSets::Use::always);
    const bool later = waiting == Waiting::never && captures_.wanted() == 0 && !all_at_rest_ &&
                       comes_late(scene_.cells().shown());
    if ((rests_ && !later) || !moving || scene_.cells().shown() == moving)
        return;
    scene_.cells().draw_at_rest(false, surfaces());
    now.cells = scene_.cells().shown();
    now.scale = shown_scale();
    report_cells(report);
}

/// The detail of the sets that are asked for next.
index::DetailQuery Session::wanted_detail(Waiting waiting, const FrameReport& report) {
    if (details_.small())
        return {};
    const render::Placement placement =
        render::Placement::of(file_->info().grid, matrix(state_.room_from_physical));
    details_.look(config_.level_of_detail ? std::span<const render::View>(views_)
                                          : std::span<const render::View>(),
                  placement);
    if (waiting == Waiting::never && config_.level_of_detail)
        return detail_for_live(waiting, report);
    index::DetailQuery all = details_.at_rest();
    all.at_rest = false; // it is the only set
    return all;
}

index::DetailQuery Session::detail_for_live(Waiting waiting, const FrameReport& report) {
    const index::SurfacesQuery wanted = surfaces();
    const auto shows = [&](const index::ExtractionPtr& set) {
        return set && set->query.of_cells() == wanted;
    };
    const index::ExtractionPtr& held = scene_.cells().held(CellSets::Use::always);
    const index::DetailQuery moving =
        details_.for_motion(quality_.cells_that_fit(interaction::Pace::moving),
                            held ? held->query.detail.most_cells : 0);
    if (shows(held) && !held->coarse() && held->cells() <= moving.most_cells)
        return held->query.detail; // it has all there is
    if (report.pace == interaction::Pace::moving || !rests_ || !shows(held)) {
        all_at_rest_ = false;
        // What is on its way comes first, so that a set comes at all while the view changes.
        const bool on_its_way = set_comes() && !detail_.at_rest && detail_.most_cells > 0 &&
                                moving.most_cells >= detail_.most_cells / 2;
        return on_its_way ? detail_ : moving;
    }
    return detail_at_rest(waiting, std::max(moving.most_cells, held->query.detail.most_cells),
                          report.time - constant_since_);
}

/// First as many cells as quads would show in the pause that a picture at rest may take, in steps,
/// so that it gets better soon; then, where slices draw them, all, which are looked for meanwhile.
/// @param moving cells of moving pictures
/// @param rested time for which the picture has been the same
index::DetailQuery Session::detail_at_rest(Waiting waiting, std::uint64_t moving,
                                           interaction::Seconds rested) {
    constexpr interaction::Seconds kUntilMeasured{0.5};
    // Costs are predicted well only near what has been drawn.
    constexpr std::uint64_t kFarthest = 8, kWorthASet = 4;
    const index::ExtractionPtr& resting = scene_.cells().held(CellSets::Use::at_rest);
    const bool shows = resting && resting->query.of_cells() == surfaces();
    const bool seen = shows && drawn_ && drawn_->cells == resting;
    const std::uint64_t drawn =
        (seen ? resting : scene_.cells().held(CellSets::Use::always))->query.detail.most_cells;
    const auto fit = quality_.cells_that_fit(interaction::Pace::settled);
    // A time that was measured late, or while others worked, takes back nothing of this picture.
    const double most = std::min(fit.value_or(0), static_cast<double>(kFarthest * drawn));
    cells_at_first_ = std::max(cells_at_first_,
                               std::bit_floor(std::max(moving, static_cast<std::uint64_t>(most))));
    index::DetailQuery last = details_.at_rest();
    const bool kept = captures_.wanted() > 0;
    const bool serves = shows && (kept || all_at_rest_ || !comes_late(resting));
    if (serves && (resting->query.detail == last || !resting->coarse()))
        return resting->query.detail;
    if (kept)
        return last;
    if (detail_.at_rest && set_comes())
        return detail_; // asking for another one now would bring the two in turn
    if (!fit && !shows && rested < kUntilMeasured)
        return scene_.cells().held(CellSets::Use::always)->query.detail;
    // Of many more cells than before, some are seen soon.
    const bool grows = serves && cells_at_first_ >= kWorthASet * resting->query.detail.most_cells &&
                       2 * resting->cells() >= resting->query.detail.most_cells;
    if (grows && !seen)
        return resting->query.detail; // it is being drawn
    all_at_rest_ |= serves && !grows && may_be_sliced(waiting);
    if (all_at_rest_)
        return last;
    const index::DetailQuery first = details_.at_first_rest(cells_at_first_);
    // A little more room is no reason for another one.
    const bool stays = serves && resting->query.detail.wished == first.wished &&
                       resting->query.detail.most_cells >= first.most_cells;
    return stays ? resting->query.detail : first;
}

/// Whether a set for pictures at rest has so many cells that another one is to be shown before it.
bool Session::comes_late(const index::ExtractionPtr& set) const {
    const std::uint64_t many = 2 * cells_at_first_;
    return set && set->query.detail.most_cells > many && set->cells() > many;
}

} // namespace isochron::app
