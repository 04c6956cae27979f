// Chooses the footprint of a frame, for all its eyes and windows, by the measured cost of drawing.
//
//     QualityController controller(Milliseconds(11.1));
//     for (const DrawSample& sample : meter.finished())
//         controller.measured(sample.footprint, sample.load, sample.cost());
//     const QualityChoice choice = controller.advance({.pace = gate.pace()});   // every frame
#pragma once

#include "app/frame/quality_reason.h"
#include "app/quality/draw_cost.h"
#include "interaction/controls/motion_gate.h"
#include "render/drawing/cell_pass.h"

#include <array>
#include <optional>

namespace isochron::app {

/// What the choice depends on, apart from measurements.
struct QualityInput {
    interaction::Pace pace = interaction::Pace::moving;
    interaction::QualityMode mode = interaction::QualityMode::automatic;
    bool playing = false; ///< time plays: every frame may bring other cells
    /// Footprints that the shown cells can be drawn with.
    render::FootprintSet available = render::FootprintSet::up_to(render::kBestFootprint);
    /// Best footprint of a settled picture, whatever it costs; empty: by measurement.
    std::optional<render::Footprint> settled;
    /// Footprint that the picture at rest gets in parts, whatever it costs; empty: none is.
    std::optional<render::Footprint> in_parts;
    /// Ignore measurements: a moving picture is drawn with quads.
    bool by_pace = false;
    DrawLoad load;
    bool operator==(const QualityInput&) const = default;
};

struct QualityChoice {
    render::Footprint footprint = render::Footprint::quad;
    QualityReason reason = QualityReason::moving;
    /// The settled picture of these cells has reached its final footprint: a capture may be taken.
    bool final = false;
    /// Draw this frame even if nothing in it has changed: its cost is not known yet.
    bool measure = false;
    std::optional<Milliseconds> cost; ///< expected, of `footprint` at this load
    std::optional<Milliseconds>
        better_cost;      ///< expected, of the next better footprint, if it does not fit
    bool retries = false; ///< a better one that did not fit is tried again within a few frames
};

/// Modes: `fast` draws quads. `auto` draws the best footprint within the budget; while the picture
/// moves, only one that is expected to fit with room to spare. `paper` draws quads while moving and
/// splats once settled. `quality` draws the best footprint of all, whatever the rate. No order of
/// costs is assumed: a better footprint may be the cheaper one.
///
/// A footprint that is measured over the budget, or expected over it at a new load, is left at
/// once.
/// It may return
/// - when the load has fallen so far that it is expected to fit with a margin, or
/// - after a wait: 16 frames after the first failure, twice as many after each further one, times
///   the budgets that a failed trial took (at most 8), at most 2048 frames. The wait starts anew at
///   16 frames once the footprint has lasted 256 frames.
/// A footprint is not tried if it may take longer than `kDearestTrial` (while moving, and beside
/// parts: than the budget), judged by its earlier times at other loads, or by a multiple of the
/// time of quads, which is measured three times before that. If quads get faster, so do its earlier
/// times, as other programs may have slowed both down. If it failed by less than three budgets, its
/// times are halved every 2048 frames, so that it is tried again. An exact surface that is not
/// tried because of that multiple alone is drawn in parts, which make no frame longer, see
/// `surface_is_guessed`; again after 2048 frames. So one load causes few frames over the budget, at
/// least 16 frames lie between a step down and a step up, and a footprint that fits is back after
/// at most 2048 settled frames.
class QualityController {
  public:
    static constexpr unsigned kShortestWait = 16, kLongestWait = 2048, kProven = 256; ///< frames
    static constexpr unsigned kSoon = 128;                                            ///< frames
    /// Longest expected time of a frame that is drawn to measure a footprint; the budget if that is
    /// longer.
    static constexpr Milliseconds kDearestTrial{400};

    explicit QualityController(Milliseconds budget) : budget_(budget) {}

    /// Adds the cost of a drawn frame; call in the order of the frames, possibly some frames later.
    /// The first frame after a change of footprint includes work that is done only once (compiling,
    /// sorting): it counts only if the footprint is known and the frame is within the budget.
    void measured(render::Footprint footprint, const DrawLoad& load, Milliseconds cost);

    /// Whether the exact surface may fit, but is not tried, as its time is only guessed, or was
    /// measured long ago: parts of it, drawn beside other frames, tell.
    bool surface_is_guessed(const QualityInput& input) const;
    /// Adds the cost of a picture that was made in parts, which tells about whole frames, too.
    void measured_in_parts(render::Footprint footprint, const DrawLoad& load, Milliseconds cost);

    /// The choice for a frame like this, if it came next.
    QualityChoice choose(const QualityInput& input) const;
    /// The choice for the frame that does come next: goes on by one frame.
    QualityChoice advance(const QualityInput& input);

    Milliseconds budget() const { return budget_; }
    /// What was measured stays; whether it fits is asked of the new budget.
    void set_budget(Milliseconds budget) { budget_ = budget; }
    /// Expected cost of a footprint; empty before it has been measured.
    std::optional<Milliseconds> expected(render::Footprint footprint, const DrawLoad& load) const {
        return costs(footprint).cost.predict(load);
    }

  private:
    /// What is known of a footprint's times.
    struct Costs {
        DrawCost cost;
        DrawCost beside;           ///< what quads were expected to cost when this one was measured
        unsigned measurements = 0; ///< that `cost` is of
    };
    /// How a footprint has stood the test so far.
    struct Candidate {
        std::optional<DrawLoad> sampled; ///< load of the newest measurement that counts
        DrawLoad failed_at;              ///< least load of the failures
        Milliseconds failed_cost{0};
        bool known = false;    ///< measured since it was last tried again
        bool outdated = false; ///< the costs are of before that
        bool fits = false;     ///< within the budget by the newest measurement
        bool failed = false;   ///< left as too slow, and not measured within the budget since
        unsigned age = 0;      ///< frames chosen by the budget since the newest measurement
        unsigned wait = kShortestWait / 2;
        unsigned lasted = 0; ///< frames since it became the current one
    };
    template <class T>
    using ByFootprint = std::array<T, render::kFootprints>;
    /// All that a choice changes.
    struct Trials {
        ByFootprint<Candidate> candidates;
        render::Footprint current = render::Footprint::quad;
        bool was_moving = true; ///< in the previous frame
        bool budgeted = false;  ///< `current` was chosen by the budget
        bool over = false;      ///< `current` was measured over the budget
        DrawLoad over_load;
        Milliseconds over_cost{0};           ///< that was measured over the budget
        unsigned since_down = kShortestWait; ///< frames since the last step down, at most this
    };
    class Rule;

    Candidate& of(render::Footprint footprint) {
        return trials_.candidates[static_cast<std::size_t>(footprint)];
    }
    Costs& costs(render::Footprint footprint) {
        return costs_[static_cast<std::size_t>(footprint)];
    }
    const Costs& costs(render::Footprint footprint) const {
        return costs_[static_cast<std::size_t>(footprint)];
    }
    void learn(render::Footprint footprint, const DrawLoad& load, Milliseconds cost);

    Milliseconds budget_;
    ByFootprint<Costs> costs_;
    Trials trials_;
    std::optional<render::Footprint> sampled_; ///< footprint of the newest measurement
};

} // namespace isochron::app
