// Chooses the footprint of a frame, once for all its eyes and windows, by what drawing has cost.
//
//     QualityController controller(Milliseconds(11.1));
//     for (const DrawSample& sample : meter.finished())
//         controller.measured(sample.footprint, sample.load, sample.cost());
//     const QualityChoice choice = controller.choose({.pace = gate.pace()});   // every frame
#pragma once

#include "app/frame/draw_cost.h"
#include "interaction/commands.h"
#include "interaction/motion_gate.h"
#include "render/cells/cell_pass.h"

#include <array>
#include <cstdint>
#include <optional>

namespace isochron::app {

/// What the choice depends on beside the measurements.
struct QualityInput {
    interaction::Pace pace = interaction::Pace::moving;
    interaction::QualityMode mode = interaction::QualityMode::automatic;
    bool playing = false; ///< time runs: every frame may bring other cells
    /// That the shown cells can be drawn with.
    render::FootprintSet available = render::FootprintSet::up_to(render::kBestFootprint);
    /// Instead of measuring: what a settled picture is drawn with at best, whatever it costs.
    std::optional<render::Footprint> settled;
    /// What moves is drawn in quads, whatever fits: nothing that is measured may count.
    bool by_pace = false;
    DrawLoad load;
};

/// Why a footprint was chosen.
enum class QualityReason : std::uint8_t {
    moving,     ///< the picture moves: the best that fits the budget with room to spare, or quads
    fast_mode,  ///< quads are asked for
    best_mode,  ///< the best is asked for, whatever it costs
    paper_mode, ///< as in the paper: splats where it is settled
    configured, ///< what a settled picture is drawn with is fixed
    fits,       ///< the best there is, within the budget
    trial,      ///< a better one than before, which is being measured
    over_budget ///< a better one does not fit
};
/// `moving`, `fast mode`, `best mode`, `paper mode`, `configured`, `fits`, `trial`, `over budget`.
const char* name_of(QualityReason reason);

struct QualityChoice {
    render::Footprint footprint = render::Footprint::quad;
    QualityReason reason = QualityReason::moving;
    /// What the settled picture ends at, for these cells: a capture may be taken.
    bool final = false;
    /// Draw this frame even if nothing in it has changed: its cost is not known yet.
    bool measure = false;
    std::optional<Milliseconds> cost; ///< expected, of `footprint` at this load
    std::optional<Milliseconds>
        better_cost; ///< likewise of the next better one, if it does not fit
};

/// Modes: `fast` draws quads. `auto` draws the best footprint within the budget; while moving with
/// room to spare, of those that are known to. `paper` draws quads while moving and splats once
/// settled, and nothing else. `quality` draws the best there is; only while time plays, so that time keeps
/// its pace, the best within the budget. No order of costs is assumed: a better footprint may be
/// the cheaper one.
///
/// A footprint measured over the budget, or expected over it at a new load, is left at once. It
/// returns
/// - when the load has fallen so that it is expected to fit with a margin, or
/// - when the bad news is old: after 16 frames, after twice as many with every failure (times the
///   budgets, up to 8, that a failed trial took; at most 2048), until it has lasted 256 frames.
/// No footprint is tried that would take longer than `kDearestTrial` (while moving: than the budget)
/// by what it took before at another load, or by what quads take where it was never drawn.
/// Hence one load causes few frames over the budget, there are at least 16 frames from a step down
/// to a step up, and after at most 2048 settled frames a footprint that fits is back.
class QualityController {
  public:
    static constexpr unsigned kShortestWait = 16, kLongestWait = 2048, kProven = 256; ///< frames
    /// What a frame may be expected to take that is drawn to learn what it takes; the budget where
    /// that is more.
    static constexpr Milliseconds kDearestTrial{400};

    explicit QualityController(Milliseconds budget) : budget_(budget) {}

    /// A frame that was drawn, in the order of the frames, soon or some frames later. The first one
    /// after a change of footprint pays for what is done only once (compiling, sorting): it counts
    /// only if it is within the budget all the same.
    void measured(render::Footprint footprint, const DrawLoad& load, Milliseconds cost);

    /// Advances by one frame.
    QualityChoice choose(const QualityInput& input);

    Milliseconds budget() const { return budget_; }

  private:
    struct Candidate {
        DrawCost cost;
        std::optional<DrawLoad> sampled; ///< load of the newest measurement that counts
        DrawLoad failed_at;              ///< least load of the failures
        Milliseconds failed_cost{0};
        bool known = false;  ///< measured since it was last forgotten
        bool fits = false;   ///< by the newest measurement
        bool failed = false; ///< left, and not proven since
        unsigned age = 0;    ///< frames under the budget's rule since the newest measurement
        unsigned wait = kShortestWait / 2;
        unsigned lasted = 0; ///< frames since it was stepped up to
    };
    Candidate& of(render::Footprint footprint) {
        return candidates_[static_cast<std::size_t>(footprint)];
    }
    const Candidate& of(render::Footprint footprint) const {
        return candidates_[static_cast<std::size_t>(footprint)];
    }

    QualityChoice choice_for(const QualityInput& input);
    QualityChoice regardless(render::Footprint footprint, QualityReason reason,
                             const DrawLoad& load);
    QualityChoice within_budget(const QualityInput& input);
    QualityChoice describe(const QualityInput& input) const;
    void turn_to(render::Footprint footprint);
    void step_down(const QualityInput& input);
    void step_up(const QualityInput& input);
    bool has_room(const QualityInput& input) const;
    bool bearable(render::Footprint footprint, const QualityInput& input) const;
    bool outgrown(const Candidate& candidate, const DrawLoad& load) const;
    bool returns(render::Footprint footprint, const QualityInput& input);
    bool decided(render::Footprint footprint, const QualityInput& input) const;
    void fail(Candidate& candidate, const DrawLoad& load, Milliseconds cost) const;

    Milliseconds budget_;
    std::array<Candidate, render::kFootprints> candidates_;
    render::Footprint current_ = render::Footprint::quad;
    bool was_moving_ = true; ///< the frame before
    bool budgeted_ = false;  ///< current_ was chosen by the budget
    bool over_ = false;      ///< current_ was measured over the budget
    DrawLoad over_load_;
    Milliseconds over_cost_{0};                ///< of that measurement
    unsigned since_down_ = kShortestWait;      ///< frames since a step down
    std::optional<render::Footprint> sampled_; ///< footprint of the newest measurement
};

} // namespace isochron::app
