// The quality of a session's frames: budgets, measured draw times, and the choice of footprint.
//
//     quality.learn(quality.collect(log));                  // every frame
//     quality.charge(quality.view(), state.isosurfaces);
//     const Choosing how = Choosing::with_parts;
//     const FramePlan plan = quality.choose(state, changed, how, footprints, possible, report);
//     if (plan.state.is_trial() || changed) {
//         quality.begin(log.next());
//         draw(views, plan.footprint);
//         quality.end(report, of_cell, processor_time);
//     }
#pragma once

#include "app/config/config.h"
#include "app/frame/explorer_state.h"
#include "app/frame/frame_log.h"
#include "app/quality/cell_resolution.h"
#include "app/quality/draw_meter.h"
#include "app/quality/frame_plan.h"
#include "app/quality/mesh_level_chooser.h"
#include "app/quality/motion_promise.h"
#include "app/quality/quality_controller.h"

#include <optional>
#include <span>
#include <vector>

namespace isochron::app {

/// What the choice of a footprint depends on: on measured times, or (`by_pace`) only on whether the
/// picture moves. A fixed-step replay must repeat exactly, so it ignores measurements and draws a
/// settled picture with the configured footprint, or with the best one if none is configured. Live
/// frames are measured; a picture at rest ends at the same footprint, drawn in parts over several
/// frames.
enum class Choosing : std::uint8_t { with_parts, by_pace };

/// Frames that change have the frame budget. A picture in which nothing has moved for a while is
/// drawn in parts, each within that budget. Where the quality or the configuration wants none, it
/// is drawn at once, within the larger still budget: a pause that is acceptable at rest. Each budget
/// has its own controller; both learn from all frames.
class FrameQuality {
  public:
    /// A picture is still after this time without a change, which is longer than the time between
    /// two poses of a slow tracker.
    static constexpr interaction::Seconds kStillAfter{0.1};

    /// @param refresh_rate [Hz] of the display, if it is known
    FrameQuality(const render::Gl& gl, const Config& config, std::optional<double> refresh_rate);

    /// While a headset paces the frames, its period replaces the period of display and
    /// configuration.
    /// @param period of the headset; empty: no headset paces the frames
    void set_headset_period(std::optional<Milliseconds> period);

    /// Frames whose times have become known since the last call; adds GPU times to their reports.
    std::vector<DrawSample> collect(FrameLog& log);
    /// Learns from the times of frames, in order.
    void learn(std::span<const DrawSample> samples);

    /// Load of one cell in every view of the last frame: the number of views, and their pixels.
    const DrawLoad& view() const { return view_; }
    /// Sets the load per cell for the next choice.
    /// @param of_cell in a cluster that of the process which draws most, as all processes draw with
    ///   the same footprint
    /// @param surfaces that are drawn: cells count once for all opaque ones, and once more for each
    ///   one that lets light through, as each is drawn in a pass of its own while it moves
    void charge(const DrawLoad& of_cell, std::span<const interaction::Isosurface> surfaces);

    /// Advances by one frame and plans how it is drawn, at its report's time and pace and with its
    /// cells; which cells come next is for others to plan. The report gets the budget and the
    /// expected costs.
    /// With parts, the plan's state says which footprint to make once nothing needs to be measured
    /// any more; from then on the choice stays until something changes. `finer_in_parts` says whether
    /// the picture ends at another footprint, made in parts.
    /// @param changed what the eyes see has changed since the last frame, apart from the footprint
    /// @param available that the cells can be drawn with
    /// @param possible the same if the cells were asked for with a mesh
    FramePlan choose(const ExplorerState& state, bool changed, Choosing how,
                     render::FootprintSet available, render::FootprintSet possible,
                     FrameReport& report);

    /// Whether a moving picture of so many cells, as quads, is expected to keep the promise.
    /// @param moves it is drawn so already: then a little more is no reason to leave it
    bool fits_in_motion(std::uint64_t cells, bool moves) const;
    /// Level of the mesh that takes the place of quads while the picture moves, if one does. It is
    /// also chosen at rest, so that it is there in the first frame that moves.
    /// @param meshes at hand; budget and expected times are added
    std::optional<std::size_t> choose_mesh(MeshesAtHand meshes);
    bool moves_as_mesh() const { return mesh_levels_.level().has_value(); } ///< by the last choice
    /// Expected time of drawing so many cells as quads; 0: not known.
    Milliseconds expected_quads(double cells) const {
        return steady_.expected(render::Footprint::quad, {cells * charged_.cells, charged_.pixels})
            .value_or(Milliseconds(0));
    }
    /// Expected time of drawing a mesh; as long as no mesh was measured, of quads that take about as
    /// long. Empty: not known.
    std::optional<Milliseconds> expected_mesh(std::size_t triangles) const;

    /// Adds what presenting a picture took besides drawing it: nothing of a frame's time can be won
    /// there by drawing less.
    void presented(Milliseconds time) { beside_ += kNewest * (time - beside_); }

    /// Whether a moving picture of so many cells takes no longer than any may.
    bool may_be_shown_in_motion(std::uint64_t cells) const;
    /// The number of cells below which no moving picture is recognized.
    std::uint64_t least_cells() const { return least_recognized(all_cells_); }

    /// Cells that quads are expected to draw in every view within the budget with room to spare, of
    /// moving pictures or of pictures at rest; empty before the first measurement.
    std::optional<double> cells_that_fit(interaction::Pace pace) const;

    /// Call before drawing the frame. @param frame its number in the log
    void begin(std::uint64_t frame);
    /// Call after drawing the frame.
    /// @param of_cell load of one cell in every view
    /// @param processor time to give the commands, including the upload
    void end(const FrameReport& report, const DrawLoad& of_cell, Milliseconds processor);

    /// Time that a frame may spend on a picture for later frames; 0: none.
    /// @param taken by the frame itself
    Milliseconds left_of_frame(Milliseconds taken) const;
    /// Time that a frame may spend on parts.
    Milliseconds part_budget() const;
    /// Learns from a picture that was made in parts, of the views that were charged.
    void learn_parts(render::Footprint footprint, std::uint64_t cells, Milliseconds time);

    /// Number of refreshes that the display missed in the time between two frames.
    unsigned missed(interaction::Seconds between) const;

  private:
    /// A choice at rest, and what it depends on.
    struct Resting {
        QualityInput input;
        FramePlan plan;
        std::optional<Milliseconds> cost; ///< expected
    };
    std::optional<render::Footprint> partial(const QualityInput& input, Choosing how) const;
    std::optional<MotionCosts> motion_costs() const;
    double least_share() const;
    std::size_t choose_resolution(const QualityChoice& choice, const FrameReport& report);
    void keep_promise(FrameReport& report, Choosing how);
    MotionPromise promise_for(Milliseconds wanted, bool in_headset) const;

    static constexpr double kNewest = 0.1; ///< share of a new time in the mean
    const std::optional<render::Footprint> settled_;
    const Milliseconds wanted_budget_, still_budget_; ///< as configured; 0: the period
    const Milliseconds longest_;                      ///< most for a moving picture, as configured
    const Milliseconds configured_period_;            ///< period of frames without a headset
    Milliseconds period_;                             ///< period of frames now
    MotionPromise promise_;
    CellResolution resolution_;
    MeshLevelChooser mesh_levels_;
    bool begun_ = false;                     ///< a picture without cells was measured
    std::optional<std::uint64_t> all_cells_; ///< cells of level 0, as last counted, or guessed
    bool counted_ = false;
    Milliseconds beside_{0}; ///< that presenting takes
    QualityController steady_, still_;
    interaction::Seconds changed_at_{0};
    interaction::Seconds swayed_for_{0}; ///< since the picture was still or moved, without waits
    interaction::Seconds frame_before_{0};
    std::optional<Resting> resting_; ///< while parts are made or shown
    DrawMeter meter_;
    DrawLoad view_;       ///< load of one cell in all views of the frame drawn last
    DrawLoad charged_;    ///< load of one cell in all views and passes
    double passes_ = 1.0; ///< over the cells
};

} // namespace isochron::app
