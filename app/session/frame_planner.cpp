// Chooses how a frame's picture is drawn.
#include "app/session/frame_planner.h"

#include "app/choice/moved_picture.h"

#include <algorithm>
#include <utility>

namespace isochron::app {
namespace {

constexpr auto kAllFootprints = render::FootprintSet::up_to(render::kBestFootprint);

} // namespace

FramePlanner::FramePlanner(const Config& config, const Outputs& outputs, FrameLog& log,
                           const Scene& scene, CellSupply& supply, const PictureMaker& pictures)
    : outputs_(outputs), log_(log), scene_(scene), sets_(scene.cells()), supply_(supply),
      pictures_(pictures),
      // Beside a headset the window's refresh rate does not count.
      quality_(outputs.gl(), config,
               outputs.headset() ? std::nullopt : outputs.windows().first().refresh_rate()) {}

/// Learns the draw costs of the slowest process, as all draw with the same footprint.
void FramePlanner::learn_costs(const Frame& frame) {
    quality_.learn(frame.sharing.samples(quality_.collect(log_)));
    quality_.charge(frame.sharing.largest(quality_.view()), frame.state.isosurfaces);
}

/// Whether a picture at rest differs from the one that is shown in nothing but more detail, and may
/// be made in parts.
bool FramePlanner::only_gets_finer(const Frame& frame, const Picture& now) const {
    if (!supply_.rests() || !frame.drawn || frame.choosing() != Choosing::with_parts ||
        now.cells == frame.drawn->cells || now.cells != sets_.held(CellSets::Use::at_rest))
        return false;
    return drawn_as(now, *frame.drawn) == frame.drawn;
}

/// Whether an exact picture only gets another size, as the panel beside it comes or goes.
bool FramePlanner::is_only_laid_out(const Frame& frame, const Picture& now) const {
    const std::optional<Picture>& drawn = frame.drawn;
    if (!drawn || !frame.sharing.alone() || !supply_.may_be_partial(frame) ||
        (drawn->footprint != render::Footprint::surface && !drawn->moved) ||
        now.cells != drawn->cells || !only_panel_differs(now.layout, drawn->layout))
        return false;
    Picture same = drawn_as(now, *drawn);
    same.layout = drawn->layout;
    return same == drawn;
}

/// Those of the footprints whose programs are ready for the surfaces of this state.
render::FootprintSet FramePlanner::ready(const Frame& frame, render::FootprintSet all) const {
    const bool by_value = frame.state.coloring.by != interaction::ColorBy::surface;
    const bool translucent = interaction::any_is(frame.state.isosurfaces, true),
               opaque = interaction::any_is(frame.state.isosurfaces, false);
    for (const auto footprint :
         {render::Footprint::gaussian, render::Footprint::mesh, render::Footprint::surface})
        if (!scene_.is_ready(footprint, opaque, translucent, by_value))
            all.remove(footprint);
    return all;
}

FramePlanner::Options FramePlanner::options(const Frame& frame, bool changed) const {
    Options options{changed, ready(frame, sets_.footprints()),
                    ready(frame, sets_.possible_footprints())};
    if (frame.report.cells > frame.sharing.surface_limit())
        for (render::FootprintSet* set : {&options.available, &options.possible})
            set->remove(render::Footprint::surface);
    return options;
}

/// Rank 0's plan, before the others follow it.
FramePlan FramePlanner::wanted(const Frame& frame, const Options& options) {
    FramePlan plan = quality_.choose(frame.state, options.changed, frame.choosing(),
                                     options.available, options.possible, frame.report);
    if (!scene_.is_ready_to_move())
        plan.resolution = 0;
    choose_mesh(frame, plan);
    // Pace says when work begins, not what is shown: what is there stays until something changes.
    if (frame.is_live() && !options.changed && !plan.state.in_parts() &&
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
void FramePlanner::choose_mesh(const Frame& frame, FramePlan& plan) {
    if (!frame.is_live() || frame.state.quality != interaction::QualityMode::automatic ||
        !sets_.may_have_meshes() || !ready(frame, kAllFootprints).has(render::Footprint::mesh))
        return;
    const auto use = supply_.finest_in_motion(frame);
    MeshesAtHand meshes;
    meshes.translucent = interaction::any_is(frame.state.isosurfaces, true);
    meshes.now = frame.report.time;
    if (use) {
        meshes.triangles = sets_.triangles(*use);
        if (meshes.translucent) // all triangles are sorted, which takes far longer than layers do
            meshes.triangles[0] = 0;
        meshes.quads = supply_.share_of_quads(frame, *use, quality_);
        meshes.quads_take =
            quality_.expected_quads(meshes.quads * static_cast<double>(sets_.held(*use)->cells()));
    }
    const auto level = quality_.choose_mesh(meshes);
    const bool passes = frame.report.pace == interaction::Pace::moving || plan.finer_in_parts;
    if (!level || !passes || plan.footprint >= render::Footprint::mesh ||
        sets_.shown() != sets_.held(*use))
        return;
    plan.footprint = render::Footprint::mesh;
    plan.mesh_level = *level;
    plan.resolution = 0;
    plan.state.stand_in();
    frame.report.expected = quality_.expected_mesh(meshes.triangles[*level]);
}

/// Whether the last exact picture is moved, as what a frame can draw of what moves is worse.
bool FramePlanner::moves_exact(const Frame& frame, const Picture& now,
                               const FramePlan& plan) const {
    const Picture* exact = scene_.movable_picture(outputs_.viewports(now.audience));
    const bool all_triangles = plan.footprint == render::Footprint::mesh && plan.mesh_level == 0;
    // What shows all of many small cells is as good: thin things move more truly than their holes and
    // rims would.
    const bool all_cells = plan.footprint == render::Footprint::mesh
                               ? plan.mesh_level <= 1
                               : frame.report.coarsest == 0 && plan.resolution <= 1;
    const bool as_good = all_triangles || (all_cells && supply_.cells_look_small());
    // Where a panel comes or goes, the picture is only shown in another size: nothing is as good.
    const bool stays = exact && stand_as(*exact, now);
    return exact && scene_.is_ready_to_move() && supply_.may_be_partial(frame) &&
           (stays || !as_good) && plan.footprint < render::Footprint::surface &&
           now.audience.eyes.empty() && may_be_moved(*exact, now, frame.report.asked);
}

/// Whether the exact picture that is moved should be drawn anew for where the eyes are.
bool FramePlanner::grows_old(const Picture& now) const {
    constexpr double kOld = kMovedAtMost / 3;
    return moved_by(*scene_.movable_picture(1), now) > kOld;
}

/// Whether a headset is given its last layer again, if that is exact: its runtime moves the layer to
/// where the eyes are. Not for long, and only where nothing else moves.
bool FramePlanner::shows_layer_again(const Frame& frame, const Picture& now) {
    constexpr interaction::Seconds kLongest{0.2};
    const std::optional<Picture>& drawn = frame.drawn;
    const bool may = supply_.may_be_partial(frame) && !now.audience.eyes.empty() && drawn &&
                     now.footprint < render::Footprint::surface &&
                     now.room_from_physical == drawn->room_from_physical &&
                     now.audience.wand == drawn->audience.wand &&
                     now.audience.panel == drawn->audience.panel &&
                     may_be_moved(*drawn, now, frame.report.asked);
    if (!may)
        again_since_.reset();
    else if (!again_since_)
        again_since_ = frame.report.time;
    return may && frame.report.time - *again_since_ <= kLongest;
}

/// Whether nothing is new but isovalues whose cells are still to come: until then the last picture
/// says by its legend what it shows.
bool FramePlanner::only_awaits_cells(const Frame& frame, const Picture& now) const {
    const std::optional<Picture>& drawn = frame.drawn;
    if (!frame.is_live() || frame.is_kept || !frame.sharing.alone() || !drawn || !drawn->cells ||
        !now.cells || !supply_.set_comes() || frame.report.shown == frame.report.asked ||
        now.cells->query.of_cells() != drawn->cells->query.of_cells() ||
        now.isosurfaces.size() != drawn->isosurfaces.size())
        return false;
    Picture same = drawn_as(now, *drawn);
    for (std::size_t i = 0; i < same.isosurfaces.size(); ++i)
        same.isosurfaces[i].isovalue = drawn->isosurfaces[i].isovalue;
    return same != now && same == drawn;
}

/// What is drawn stays, and the report says how it was drawn.
void FramePlanner::show_last(const Frame& frame) const {
    FrameReport& report = frame.report;
    frame.plan.state.hold();
    report.footprint = frame.drawn->footprint;
    report.resolution = frame.drawn->resolution;
    report.mesh_level = frame.drawn->mesh_level;
    report.moved = frame.drawn->moved;
}

/// Takes over rank 0's plan.
void FramePlanner::agree(const Frame& frame, FramePlan plan) {
    // More cells than a frame can draw come in parts alone, which may begin some frames later. So
    // do far more cells than the last frame drew: their time is not known well.
    constexpr std::size_t kFarMore = 4;
    FrameReport& report = frame.report;
    const bool near = !frame.drawn || !frame.drawn->cells ||
                      report.cells <= kFarMore * frame.drawn->cells->cells();
    const bool fits = near && report.expected && *report.expected <= report.budget;
    plan.state.share_parts(frame.sharing.parts_are_whole());
    plan.finer_in_parts &= !fits;
    plan.all_at_rest = frame.plan.all_at_rest;
    frame.plan = frame.sharing.agree(plan);
    report.in_parts = frame.plan.state.in_parts();
    report.footprint = frame.plan.footprint;
    report.resolution = frame.plan.resolution;
    report.mesh_level = frame.plan.mesh_level;
    report.moved = frame.plan.state.is_moved();
    const auto use = supply_.finest_in_motion(frame);
    const bool is_mesh = report.footprint == render::Footprint::mesh && use;
    report.triangles = is_mesh ? sets_.triangles(*use)[report.mesh_level] : 0;
    report.reason = frame.plan.reason;
    report.final = frame.plan.state.is_final();
}

void FramePlanner::choose(const Frame& frame, Picture& now) {
    FrameReport& report = frame.report;
    learn_costs(frame);
    if (supply_.choose_set(frame, now))
        pictures_.show_cells(now, frame.state);
    if (frame.is_live() && !log_.frames().empty() && !report.after_wait)
        report.missed = quality_.missed(report.time - log_.frames().back().time);
    const bool finer = only_gets_finer(frame, now);
    const bool changed = !frame.drawn || !same_cells(now, *frame.drawn);
    const bool laid_out = is_only_laid_out(frame, now);
    const Options options = this->options(frame, changed && !finer && !laid_out);
    const bool had_mesh = frame.plan.mesh;
    const index::DetailQuery had_detail = frame.plan.detail;
    FramePlan plan = wanted(frame, options);
    plan.detail = supply_.wanted_detail(frame, quality_);
    plan.moves_finest = supply_.may_move_finest(frame, quality_);
    if (!supply_.is_finest(frame) || (frame.is_live() && plan.detail != had_detail))
        plan.state.improve();
    // What stands at rest stays until its exact picture is shown. What it stands for is not measured
    // before it is needed.
    if ((changed || now.moved) && moves_exact(frame, now, plan))
        plan.state.move();
    plan.state.draw_ahead(!supply_.rests() && report.shown == report.asked &&
                          (plan.state.draws_ahead() || (plan.state.is_moved() && grows_old(now))));
    agree(frame, plan);
    // A replay's picture is as good as it gets at once.
    if (!frame.is_live() && ((frame.plan.mesh && !had_mesh) || frame.plan.detail != had_detail)) {
        supply_.request(frame);
        supply_.take_newest(frame);
        pictures_.show_cells(now, frame.state);
        const render::FootprintSet available = ready(frame, sets_.footprints());
        plan = wanted(frame, {options.changed, available, available});
        plan.detail = frame.plan.detail;
        agree(frame, plan);
    }
    now.footprint = report.footprint;
    now.resolution = report.resolution;
    now.mesh_level = report.mesh_level;
    now.moved = report.moved;
    rest_in_parts(frame, now);
    if (finer && frame.plan.finer_in_parts)
        frame.plan.state.hold();
    if (laid_out && report.in_parts && !report.moved)
        show_last(frame);
    if (only_awaits_cells(frame, now)) {
        show_last(frame);
        frame.plan.state.give_up_parts();
        report.in_parts.reset();
        report.final = false;
    }
    if (shows_layer_again(frame, now)) {
        frame.plan.state.hold();
        report.moved = true;
        report.final = false;
    }
    // While a headset wants no picture, there is nothing to draw or to measure.
    const PictureState& state = frame.plan.state;
    report.redrawn =
        outputs_.want(now.audience) && !state.is_held() && (now != frame.drawn || state.is_trial());
}

/// Shows the picture at rest that was made in parts for as long as nothing changes.
void FramePlanner::rest_in_parts(const Frame& frame, Picture& now) const {
    FrameReport& report = frame.report;
    if (!report.in_parts || !frame.drawn)
        return;
    now.footprint = *report.in_parts;
    now.mesh_level = 0;
    now.moved = false;
    const bool shown = same_cells(now, *frame.drawn);
    if (!shown) {
        now.footprint = report.footprint;
        now.mesh_level = report.mesh_level;
        now.moved = report.moved;
    }
    report.footprint = now.footprint;
    report.mesh_level = now.mesh_level;
    report.moved = now.moved;
    report.reason = QualityReason::in_parts;
    report.final = shown && supply_.is_finest(frame);
    if (shown)
        report.expected = std::exchange(report.better, std::nullopt);
}

} // namespace isochron::app
