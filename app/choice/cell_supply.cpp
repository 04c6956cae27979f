// Which cells a session asks for, and how they come to the GPU.
#include "app/choice/cell_supply.h"

#include "app/frame/steps_ahead.h"
#include "app/frame/stop_watch.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace isochron::app {
namespace {

CellSets::Use use_of(const index::ExtractionPtr& set) {
    return set && set->query.detail.at_rest ? CellSets::Use::at_rest : CellSets::Use::always;
}

/// Sets have about as many cells as they may: levels change by regions.
constexpr double kNearly = 0.6;

/// Whether a set shows the cells that this frame asks for.
bool shows(const index::ExtractionPtr& set, const Frame& frame) {
    return set && set->query.of_cells() == frame.report.asked;
}

} // namespace

CellSupply::CellSupply(const Config& config, std::shared_ptr<const index::IndexFile> file,
                       CellSets& sets, index::Extract extract, index::Shading shading)
    : config_(config), sets_(sets), newest_(std::make_shared<index::NewestIndex>(file)),
      extractor_(extract ? std::move(extract) : index::extract_from_newest(newest_, shading),
                 file->cache_bytes() / 2),
      details_(file->info().grid, static_cast<std::uint64_t>(config_.memory.most_cells)) {
    messages_ = limit_to_memory(details_, *file);
}

void CellSupply::set_file(std::shared_ptr<const index::IndexFile> file) {
    newest_->set(std::move(file));
    extractor_.forget(); // color coordinates span all times, or all values of the second array
}

std::vector<std::string> CellSupply::take_messages() {
    return std::exchange(messages_, {});
}

void CellSupply::request(const Frame& frame) {
    index::SurfacesQuery query = frame.report.asked;
    const bool meshes = frame.is_live() && sets_.may_have_meshes() &&
                        frame.state.quality == interaction::QualityMode::automatic;
    // Nothing is chosen before the first frame, which does not ask for all cells of a large volume.
    if (frame.plan.detail.most_cells == 0)
        frame.plan.detail.most_cells =
            details_.most_at_first(frame.is_live() && config_.rendering.level_of_detail);
    query.detail = frame.plan.detail;
    query.mesh_room =
        frame.plan.mesh && !(meshes && is_there(query)) ? config_.memory.mesh_room() : 0;
    index::Request request{frame.sharing.ask(query, frame.waiting), std::nullopt};
    // While the picture at rest is made, drawing has the processors, unless it may use the meshes.
    const auto finest = finest_in_motion(frame);
    const PictureState& state = frame.plan.state;
    const bool whole =
        state.is_final() || (frame.drawn && state.in_parts() == frame.drawn->footprint);
    const bool now = whole || frame.plan.mesh || frame.report.pace == interaction::Pace::moving;
    if (meshes && finest && now) {
        request.meshes_of = sets_.held(*finest);
        request.later_room = config_.memory.mesh_room();
    }
    const index::ExtractionPtr& moving = sets_.held(CellSets::Use::always);
    request.before_meshes = moving && details_.lacks_what_is_seen(moving->query.detail);
    if (frame.state.playback.playing)
        request.ahead = steps_ahead(request.query.instant, frame.state,
                                    std::span(frame.file.info().times).first(frame.steps));
    extractor_.request(request);
    frame.report.extracting = extractor_.busy();
}

/// Whether what is asked for is there already: then its mesh comes later, and the set stays.
bool CellSupply::is_there(const index::SurfacesQuery& query) const {
    const index::ExtractionPtr newest = extractor_.newest();
    if (!newest)
        return false;
    index::SurfacesQuery same = newest->query;
    same.mesh_room = query.mesh_room;
    return same == query;
}

/// Whether what was found last is on the GPU, or will never be.
bool CellSupply::has_taken_newest() const {
    const index::ExtractionPtr newest = extractor_.newest();
    return !newest || newest == refused_ || newest == sets_.held(use_of(newest));
}

void CellSupply::take_newest(const Frame& frame) {
    FrameReport& report = frame.report;
    const render::UploadCount before = sets_.uploaded();
    StopWatch watch;
    if (!frame.is_live()) {
        sets_.send_whole();
        extractor_.wait();
        report.wait = watch.lap();
    }
    CellsInFrame cells = frame.sharing.cells(extractor_, sets_.shown(), frame.waiting);
    const bool in_motion = frame.is_live() && report.pace == interaction::Pace::moving;
    const auto volume = in_motion ? render::SendVolume::never : render::SendVolume::with_cells;
    if (cells.show && !waits_its_turn(*cells.show, frame) && !comes_too_late(*cells.show, frame))
        sets_.upload(*cells.show, volume, use_of(*cells.show));
    // A replay uploads all cells that were asked for in one frame, whatever the upload budget.
    while (!frame.is_live() && *cells.show && sets_.held(use_of(*cells.show)) != *cells.show) {
        sets_.upload(*cells.show, render::SendVolume::with_cells, use_of(*cells.show));
        if (const std::string refusal = sets_.refusal(*cells.show); !refusal.empty()) {
            if (!give_way(*cells.show, frame.plan))
                throw render::Error(refusal);
            request(frame);
            extractor_.wait();
            cells = frame.sharing.cells(extractor_, sets_.shown(), frame.waiting);
        }
    }
    sets_.draw_at_rest((!in_motion || moves_finest(frame)) && !is_half_sent(frame),
                       frame.report.asked);
    if (cells.show)
        say_refused(*cells.show, frame);
    if (cells.stage && sets_.stage(cells.stage, use_of(cells.stage)))
        frame.sharing.staged();
    if (!sets_.is_complete()) // the picture has not come to rest
        report.pace = interaction::Pace::moving;
    report.upload = watch.lap();
    report.uploaded = sets_.uploaded().since(before);
    report_cells(report);
}

void CellSupply::report_cells(FrameReport& report) const {
    const index::ExtractionPtr& shown = sets_.shown();
    if (!shown)
        return;
    report.shown = shown->query.of_cells();
    report.cells = shown->cells();
    report.coarsest = shown->coarse() ? std::ranges::max(shown->detail) : 0;
    report.finest = shown->coarse() ? std::ranges::min(shown->detail) : 0;
    for (const CellSets::Use use : {CellSets::Use::at_rest, CellSets::Use::always})
        if (const index::ExtractionPtr& set = sets_.held(use);
            set && set->volume_cells && set->query.of_cells() == shown->query.of_cells())
            report.volume_cells = set->volume_cells;
    report.candidates = shown->candidates();
    report.reused = shown->reused();
    report.search = shown->search_time();
    report.gather = shown->gather_time;
}

/// Whether the volume of the resting set is still on its way to the GPU while the moving set shows
/// the same surfaces. Without its volume the resting set would be drawn in one frame, as moving
/// pictures are.
bool CellSupply::is_half_sent(const Frame& frame) const {
    const index::ExtractionPtr& moving = sets_.held(CellSets::Use::always);
    return !frame.is_kept && shows(moving, frame) && !sets_.is_complete(CellSets::Use::at_rest);
}

/// Whether the new set is slow to draw compared with the resting picture in progress, so that the
/// resting picture should be finished first.
bool CellSupply::waits_its_turn(const index::ExtractionPtr& set, const Frame& frame) const {
    constexpr std::size_t kManyMore = 8;
    const index::ExtractionPtr& resting = sets_.held(CellSets::Use::at_rest);
    return set && resting && frame.plan.all_at_rest && set != resting &&
           set->query.detail.at_rest && resting->query.of_cells() == set->query.of_cells() &&
           frame.drawn && frame.drawn->cells != resting &&
           set->cells() > kManyMore * resting->cells();
}

/// Whether a moving set that was asked for before the picture came to rest has fewer cells than the
/// moving set on the GPU: a picture at rest only gets better.
bool CellSupply::comes_too_late(const index::ExtractionPtr& set, const Frame& frame) const {
    const index::ExtractionPtr& moving = sets_.held(CellSets::Use::always);
    return frame.is_live() && rests_ && set && moving && !set->query.detail.at_rest &&
           set->query.of_cells() == moving->query.of_cells() &&
           set->query.detail.most_cells < moving->query.detail.most_cells;
}

bool CellSupply::set_comes() const {
    return extractor_.busy() || !has_taken_newest();
}

/// Asks for fewer cells from now on, as the cells of this set could not be shown.
/// @return false if there is nothing coarser
bool CellSupply::give_way(const index::ExtractionPtr& set, FramePlan& plan) {
    const std::uint64_t before = details_.most();
    details_.limit(std::min<std::uint64_t>(set->cells(), before) / 2);
    std::uint64_t& most = plan.detail.most_cells;
    most = std::min(most == 0 ? before : most, details_.most());
    return details_.most() < before;
}

/// Says once, in one line, that a set is too large to be shown, and asks for fewer cells.
void CellSupply::say_refused(const index::ExtractionPtr& set, const Frame& frame) {
    FrameReport& report = frame.report;
    report.refused = sets_.refusal(set);
    if (report.refused.empty()) {
        refused_ = nullptr;
    } else if (set != refused_) { // which may be refused with the same words as the last one
        messages_.push_back(report.refused);
        give_way(set, frame.plan);
        refused_ = set;
    }
}

bool CellSupply::is_finest(const Frame& frame) const {
    const index::ExtractionPtr& shown = sets_.shown();
    return !frame.is_live() || !shown || !shown->coarse() ||
           (shown->query.detail == frame.plan.detail &&
            (frame.plan.detail.at_rest || wants_all(frame)));
}

bool CellSupply::may_be_partial(const Frame& frame) const {
    return frame.choosing() == Choosing::with_parts && config_.quality.still_budget_ms > 0 &&
           frame.state.quality == interaction::QualityMode::automatic &&
           !(frame.state.playback.playing && frame.report.pace == interaction::Pace::moving);
}

bool CellSupply::choose_set(const Frame& frame, const Picture& now) {
    Picture same = frame.drawn ? drawn_as(now, *frame.drawn) : now;
    if (frame.drawn && only_panel_differs(now.layout, frame.drawn->layout))
        same.layout = frame.drawn->layout;
    const bool stays = frame.drawn && same_cells(same, *frame.drawn);
    if (!stays) {
        constant_since_ = frame.report.time;
        cells_at_first_ = 0;
        frame.plan.all_at_rest = false;
    }
    rests_ = !frame.is_live() || frame.is_kept ||
             frame.report.time - constant_since_ >= FrameQuality::kStillAfter;
    const index::ExtractionPtr& resting = sets_.held(CellSets::Use::at_rest);
    const bool newest = shows(resting, frame) || !shows(sets_.held(CellSets::Use::always), frame);
    if (frame.is_live() && stays && resting && frame.drawn->cells == resting && newest) {
        // Pace says when work begins, not which of two sets is shown; and what is there is shown
        // until what was asked for has come.
        if (sets_.shown() == resting)
            return false;
        sets_.draw_at_rest(true, resting->query.of_cells());
        report_cells(frame.report);
        return true;
    }
    const index::ExtractionPtr& moving = sets_.held(CellSets::Use::always);
    const bool later =
        frame.is_live() && !frame.is_kept && !frame.plan.all_at_rest && comes_late(sets_.shown());
    if ((rests_ && !later) || !moving || sets_.shown() == moving || moves_finest(frame))
        return false;
    sets_.draw_at_rest(false, frame.report.asked);
    report_cells(frame.report);
    return true;
}

/// Whether the mode asks for all cells, moving and at rest, whatever the rate.
bool CellSupply::wants_all(const Frame& frame) {
    return frame.state.quality == interaction::QualityMode::fast ||
           frame.state.quality == interaction::QualityMode::quality;
}

/// Whether the plan shows the set for pictures at rest while the picture moves: it is there, has what
/// is asked for, and moving pictures of it keep the promise.
bool CellSupply::moves_finest(const Frame& frame) {
    return frame.is_live() && frame.plan.moves_finest;
}

std::optional<CellSets::Use> CellSupply::finest_in_motion(const Frame& frame) const {
    for (const CellSets::Use use : {CellSets::Use::at_rest, CellSets::Use::always})
        if (const index::ExtractionPtr& set = sets_.held(use); shows(set, frame) && !set->coarse())
            return use;
    return std::nullopt;
}

double CellSupply::share_of_quads(const Frame& frame, CellSets::Use finest,
                                  const FrameQuality& quality) const {
    const std::uint64_t all = sets_.held(finest)->cells();
    if (finest == CellSets::Use::always || quality.fits_in_motion(all, false))
        return 1;
    const index::ExtractionPtr& moving = sets_.held(CellSets::Use::always);
    return shows(moving, frame) ? static_cast<double>(moving->cells()) / static_cast<double>(all)
                                : 0;
}

bool CellSupply::may_move_finest(const Frame& frame, const FrameQuality& quality) const {
    const index::ExtractionPtr& resting = sets_.held(CellSets::Use::at_rest);
    if (!frame.is_live() || !shows(resting, frame))
        return false;
    const index::ExtractionPtr& moving = sets_.held(CellSets::Use::always);
    const bool lacks =
        !moving || !shows(moving, frame) || details_.lacks_what_is_seen(moving->query.detail) ||
        static_cast<double>(moving->cells()) < kNearly * static_cast<double>(quality.least_cells());
    const bool as_mesh = quality.moves_as_mesh() && !resting->coarse();
    return as_mesh || quality.fits_in_motion(resting->cells(), frame.plan.moves_finest) ||
           (lacks && quality.may_be_shown_in_motion(resting->cells()));
}

index::DetailQuery CellSupply::wanted_detail(const Frame& frame, const FrameQuality& quality) {
    if (details_.small())
        return {};
    const render::Placement placement =
        render::Placement::of(frame.file.info().grid, matrix(frame.state.room_from_physical));
    details_.look(config_.rendering.level_of_detail ? std::span<const render::View>(views_)
                                                    : std::span<const render::View>(),
                  placement);
    if (frame.is_live() && config_.rendering.level_of_detail && !wants_all(frame))
        return detail_for_live(frame, quality);
    index::DetailQuery all = details_.at_rest();
    if (frame.is_live() && set_comes() && !frame.plan.detail.at_rest &&
        frame.plan.detail.most_cells == all.most_cells)
        return frame.plan.detail; // so that a set comes at all while the view changes
    all.at_rest = false;          // it is the only set
    return all;
}

index::DetailQuery CellSupply::detail_for_live(const Frame& frame, const FrameQuality& quality) {
    FramePlan& plan = frame.plan;
    const index::ExtractionPtr& held = sets_.held(CellSets::Use::always);
    const index::DetailQuery moving =
        details_.for_motion(quality.cells_that_fit(interaction::Pace::moving),
                            held ? held->query.detail.most_cells : 0, quality.least_cells());
    if (shows(held, frame) && !held->coarse() && held->cells() <= moving.most_cells)
        return held->query.detail; // it has all there is
    // Motion may begin at any time: it is recognized before the picture at rest gets its cells. How
    // many that takes is estimated from few cells.
    const bool few =
        held && !shows(sets_.held(CellSets::Use::at_rest), frame) &&
        held->query.detail.most_cells < std::min(quality.least_cells(), moving.most_cells) / 2;
    const bool elsewhere = held && details_.is_for_other_views(held->query.detail, moving);
    const bool lacks = held && held->coarse() && (few || elsewhere);
    if (frame.report.pace == interaction::Pace::moving || !rests_ || !shows(held, frame) || lacks) {
        plan.all_at_rest = false;
        // What is on its way comes first, so that a set comes at all while the view changes.
        const bool on_its_way = set_comes() && !plan.detail.at_rest && plan.detail.most_cells > 0 &&
                                moving.most_cells >= plan.detail.most_cells / 2;
        return on_its_way ? plan.detail : moving;
    }
    return detail_at_rest(frame, quality,
                          std::max(moving.most_cells, held->query.detail.most_cells));
}

/// Where all cells are there, they stay. Else the first resting set has as many cells as quads can draw in the pause that a picture at rest
/// may take; its size grows in steps, so that the picture soon gets better. The last resting set,
/// where it can be drawn in parts, has all cells: they are searched for meanwhile.
/// @param moving cells of moving pictures
index::DetailQuery CellSupply::detail_at_rest(const Frame& frame, const FrameQuality& quality,
                                              std::uint64_t moving) {
    constexpr interaction::Seconds kUntilMeasured{0.5};
    // Costs are predicted well only near what has been drawn.
    constexpr std::uint64_t kFarthest = 8, kWorthASet = 4;
    const index::ExtractionPtr& resting = sets_.held(CellSets::Use::at_rest);
    const bool is_there = shows(resting, frame);
    const bool seen = is_there && frame.drawn && frame.drawn->cells == resting;
    const std::uint64_t drawn =
        (seen ? resting : sets_.held(CellSets::Use::always))->query.detail.most_cells;
    const auto fit = quality.cells_that_fit(interaction::Pace::settled);
    // A draw time that was measured late, or beside other work, must not make this picture coarser.
    const double most = std::min(fit.value_or(0), static_cast<double>(kFarthest * drawn));
    cells_at_first_ = std::max(cells_at_first_,
                               std::bit_floor(std::max(moving, static_cast<std::uint64_t>(most))));
    index::DetailQuery last = details_.at_rest();
    const bool kept = frame.is_kept;
    const bool is_whole = is_there && (resting->query.detail == last || !resting->coarse());
    // All cells that are there already stay: a smaller set would only take their place for a moment.
    frame.plan.all_at_rest |= is_whole && may_be_partial(frame);
    const bool serves = is_there && (kept || frame.plan.all_at_rest || !comes_late(resting));
    if (serves && is_whole)
        return resting->query.detail;
    if (kept)
        return last;
    if (frame.plan.detail.at_rest && set_comes())
        return frame.plan.detail; // asking for another one now would bring the two in turn
    if (!fit && !is_there && frame.report.time - constant_since_ < kUntilMeasured)
        return sets_.held(CellSets::Use::always)->query.detail;
    // When many more cells than before come, some of them are seen soon.
    const bool grows = serves && cells_at_first_ >= kWorthASet * resting->query.detail.most_cells &&
                       2 * resting->cells() >= resting->query.detail.most_cells;
    if (grows && !seen)
        return resting->query.detail; // it is being drawn
    frame.plan.all_at_rest |= serves && !grows && may_be_partial(frame);
    if (frame.plan.all_at_rest)
        return last;
    const index::DetailQuery first = details_.at_first_rest(cells_at_first_);
    // A little more room is no reason for another one.
    const bool stays = serves && resting->query.detail.wished == first.wished &&
                       resting->query.detail.most_cells >= first.most_cells;
    return stays ? resting->query.detail : first;
}

/// Whether a set for pictures at rest has so many cells that a smaller set is to be shown first.
bool CellSupply::comes_late(const index::ExtractionPtr& set) const {
    const std::uint64_t many = 2 * cells_at_first_;
    return set && set->query.detail.most_cells > many && set->cells() > many;
}

} // namespace isochron::app
