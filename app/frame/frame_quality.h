// The quality of a session's frames: budgets, measurement and choice brought together.
//
//     quality.learn(quality.collect(log));                  // every frame
//     quality.charge(quality.view());
//     const Choosing how = Choosing::by_measurement;
//     if (quality.choose(state, changed, how, footprints, possible, report) || changed) {
//         quality.begin(log.next());
//         draw(views, report.footprint);
//         quality.end(report, of_cell, processor_time);
//     }
#pragma once

#include "app/config/config.h"
#include "app/frame/draw_meter.h"
#include "app/frame/explorer_state.h"
#include "app/frame/frame_log.h"
#include "app/frame/quality_controller.h"

#include <optional>
#include <span>
#include <vector>

namespace isochron::app {

/// What a choice of footprint may depend on. A fixed-step replay repeats exactly: there a settled
/// picture is drawn with what is configured, or the best there is, and nothing measured counts.
enum class Choosing : std::uint8_t { by_measurement, by_pace };

/// Frames that are drawn one after the other have the frame budget. A picture in which nothing has
/// moved for a while is drawn once and then only shown: it has the still budget, the pause that may
/// be felt when it comes to rest. Each has a controller, and both learn from all frames.
class FrameQuality {
  public:
    /// A tracker slower than this does not look still between two of its poses.
    static constexpr interaction::Seconds kStillAfter{0.1};

    /// @param refresh_rate [Hz] of the display, if it is known
    FrameQuality(const render::Gl& gl, const Config& config, std::optional<double> refresh_rate);

    /// A headset's period counts in the place of display and configuration while it paces the frames.
    /// @param period empty: it does not
    void set_headset_period(std::optional<Milliseconds> period);

    /// Frames whose times are known by now, each once; completes their reports.
    std::vector<DrawSample> collect(FrameLog& log);
    /// Learns from frames, in their order.
    void learn(std::span<const DrawSample> samples);

    /// What drawing one cell in every view of the last frame comes to.
    const DrawLoad& view() const { return view_; }
    /// What the next choice counts on for that: all processes draw with the same footprint, so
    /// it is that of the one that draws most.
    void charge(const DrawLoad& of_cell) { charged_ = of_cell; }

    /// Advances by one frame and says in its report how it is drawn, at the report's time and pace
    /// and with its cells.
    /// @param changed what the eyes see is not what they saw last, beside the footprint
    /// @return true: draw even if nothing has changed, so that the cost gets known
    /// @param available that the cells can be drawn with
    /// @param possible likewise, if they came with a mesh where they can
    bool choose(const ExplorerState& state, bool changed, Choosing how,
                render::FootprintSet available, render::FootprintSet possible, FrameReport& report);

    /// Whether the last choice would have been a mesh if there had been one.
    bool wants_mesh() const { return wants_mesh_; }

    /// Between these two, the frame is drawn.
    void begin(std::uint64_t frame);
    /// @param of_cell what one cell in every view came to
    /// @param processor time of giving the commands, with the upload
    void end(const FrameReport& report, const DrawLoad& of_cell, Milliseconds processor);

    /// Refreshes of the display that passed without a new frame in the time between two frames.
    unsigned missed(interaction::Seconds between) const;

  private:
    const std::optional<render::Footprint> settled_;
    const Milliseconds wanted_budget_, still_budget_; ///< as configured; 0: as the period
    const Milliseconds configured_period_;            ///< as display and configuration allow
    Milliseconds period_;                             ///< of frames
    QualityController steady_, still_;
    interaction::Seconds changed_at_{0};
    DrawMeter meter_;
    DrawLoad view_; ///< of one cell in the frame drawn last
    DrawLoad charged_;
    bool wants_mesh_ = false;
};

} // namespace isochron::app
