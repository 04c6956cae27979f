// Chooses how a frame's picture is drawn.
#include "app/session/picture_choice.h"

#include <utility>

namespace isochron::app {

PictureChoice::PictureChoice(const Config& config, const Outputs& outputs, FrameLog& log,
                             const CellSets& sets, CellSupply& supply, const PictureMaker& pictures)
    : outputs_(outputs), log_(log), sets_(sets), supply_(supply), pictures_(pictures),
      // Beside a headset the window's refresh rate does not count.
      quality_(outputs.gl(), config,
               outputs.headset() ? std::nullopt : outputs.windows().first().refresh_rate()) {}

/// Learns the draw costs of the slowest process, as all draw with the same footprint.
void PictureChoice::learn_costs(const Frame& frame) {
    quality_.learn(frame.sharing.samples(quality_.collect(log_)));
    quality_.charge(frame.sharing.largest(quality_.view()));
}

/// Whether a picture at rest differs from the one that is shown in nothing but more detail, and may
/// be made in parts.
bool PictureChoice::only_gets_finer(const Frame& frame, const Picture& now) const {
    if (!supply_.rests() || !frame.drawn || frame.choosing() != Choosing::with_parts ||
        now.cells == frame.drawn->cells || now.cells != sets_.held(CellSets::Use::at_rest))
        return false;
    Picture same = now;
    same.cells = frame.drawn->cells;
    same.footprint = frame.drawn->footprint;
    same.resolution = frame.drawn->resolution;
    same.mesh_level = frame.drawn->mesh_level;
    same.scale = frame.drawn->scale; // whose range may be percentiles of the cells
    return same == frame.drawn;
}

PictureChoice::Options PictureChoice::options(const Frame& frame, bool changed) const {
    Options options{changed, sets_.footprints(), sets_.possible_footprints()};
    if (frame.report.cells > frame.sharing.surface_limit())
        for (render::FootprintSet* set : {&options.available, &options.possible})
            set->remove(render::Footprint::surface);
    return options;
}

/// Rank 0's plan, before the others follow it.
FramePlan PictureChoice::wanted(const Frame& frame, const Options& options) {
    FramePlan plan = quality_.choose(frame.state, options.changed, frame.choosing(),
                                     options.available, options.possible, frame.report);
    choose_mesh(frame, plan);
    // Pace says when work begins, not what is shown: what is there stays until something changes.
    if (frame.is_live() && !options.changed && !plan.in_parts &&
        plan.reason == QualityReason::moving && frame.drawn->footprint > plan.footprint &&
        options.available.has(frame.drawn->footprint)) {
        plan.footprint = frame.drawn->footprint;
        plan.resolution = frame.drawn->resolution;
        plan.mesh_level = frame.drawn->mesh_level;
    }
    return plan;
}

/// A mesh takes the place of quads where it fits while the picture moves, until the picture
/// at rest is made.
void PictureChoice::choose_mesh(const Frame& frame, FramePlan& plan) {
    if (!frame.is_live() || frame.state.quality != interaction::QualityMode::automatic ||
        !sets_.may_have_meshes())
        return;
    const auto use = supply_.finest_in_motion(frame);
    std::array<std::size_t, index::kMeshLevels> triangles{};
    if (use)
        triangles = sets_.triangles(*use);
    const double quads = use ? supply_.share_of_quads(frame, *use, quality_) : 1;
    const auto level = quality_.choose_mesh(triangles, quads, frame.report.time);
    const bool passes = frame.report.pace == interaction::Pace::moving || plan.holds_finer;
    if (!level || !passes || plan.footprint >= render::Footprint::mesh ||
        sets_.shown() != sets_.held(*use))
        return;
    plan.footprint = render::Footprint::mesh;
    plan.mesh_level = *level;
    plan.resolution = 0;
    plan.measure = plan.final = false;
    frame.report.expected = quality_.expected_mesh(triangles[*level]);
}

/// Takes over rank 0's plan.
void PictureChoice::agree(const Frame& frame, FramePlan plan) {
    // More cells than a frame can draw come in parts alone, which may begin some frames later. So
    // do far more cells than the last frame drew: their time is not known well.
    constexpr std::size_t kFarMore = 4;
    FrameReport& report = frame.report;
    const bool near = !frame.drawn || !frame.drawn->cells ||
                      report.cells <= kFarMore * frame.drawn->cells->cells();
    const bool fits = near && report.expected && *report.expected <= report.budget;
    plan.shows_parts = frame.sharing.parts_are_whole();
    plan.holds_finer &= !fits;
    plan.all_at_rest = frame.plan.all_at_rest;
    frame.plan = frame.sharing.agree(plan);
    report.in_parts = frame.plan.in_parts;
    report.footprint = frame.plan.footprint;
    report.resolution = frame.plan.resolution;
    report.mesh_level = frame.plan.mesh_level;
    const auto use = supply_.finest_in_motion(frame);
    const bool is_mesh = report.footprint == render::Footprint::mesh && use;
    report.triangles = is_mesh ? sets_.triangles(*use)[report.mesh_level] : 0;
    report.reason = frame.plan.reason;
    report.final = frame.plan.final;
}

void PictureChoice::choose(const Frame& frame, Picture& now) {
    FrameReport& report = frame.report;
    learn_costs(frame);
    if (supply_.choose_set(frame, now))
        pictures_.show_cells(now, frame.state);
    if (frame.is_live() && !log_.frames().empty() && !report.after_wait)
        report.missed = quality_.missed(report.time - log_.frames().back().time);
    const bool finer = only_gets_finer(frame, now);
    const bool changed = !frame.drawn || !same_cells(now, *frame.drawn);
    const Options options = this->options(frame, changed && !finer);
    const bool had_mesh = frame.plan.mesh;
    const index::DetailQuery had_detail = frame.plan.detail;
    FramePlan plan = wanted(frame, options);
    plan.detail = supply_.wanted_detail(frame, quality_);
    plan.moves_finest = supply_.may_move_finest(frame, quality_);
    plan.final &= supply_.is_finest(frame) && (!frame.is_live() || plan.detail == had_detail);
    agree(frame, plan);
    // A replay's picture is as good as it gets at once.
    if (!frame.is_live() && ((frame.plan.mesh && !had_mesh) || frame.plan.detail != had_detail)) {
        supply_.request(frame);
        supply_.take_newest(frame);
        pictures_.show_cells(now, frame.state);
        const render::FootprintSet available = sets_.footprints();
        plan = wanted(frame, {options.changed, available, available});
        plan.detail = frame.plan.detail;
        agree(frame, plan);
    }
    now.footprint = report.footprint;
    now.resolution = report.resolution;
    now.mesh_level = report.mesh_level;
    rest_in_parts(frame, now);
    frame.plan.holds_finer &= finer;
    // While a headset wants no picture, there is nothing to draw or to measure.
    report.redrawn = outputs_.want(now.audience) && (now != frame.drawn || frame.plan.measure) &&
                     !frame.plan.holds_finer;
}

/// Shows the picture at rest that was made in parts for as long as nothing changes.
void PictureChoice::rest_in_parts(const Frame& frame, Picture& now) const {
    FrameReport& report = frame.report;
    if (!report.in_parts || !frame.drawn)
        return;
    now.footprint = *report.in_parts;
    now.mesh_level = 0;
    const bool shown = same_cells(now, *frame.drawn);
    if (!shown) {
        now.footprint = report.footprint;
        now.mesh_level = report.mesh_level;
    }
    report.footprint = now.footprint;
    report.mesh_level = now.mesh_level;
    report.reason = QualityReason::in_parts;
    report.final = shown && supply_.is_finest(frame);
    if (shown)
        report.expected = std::exchange(report.better, std::nullopt);
}

} // namespace isochron::app
