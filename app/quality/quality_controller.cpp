// Chooses the footprint of a frame by the measured cost of drawing.
#include "app/quality/quality_controller.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace isochron::app {
namespace {

using interaction::Pace;
using interaction::QualityMode;
using render::Footprint;

constexpr double kMargin =
    0.8; ///< share of the budget that a new footprint may be expected to take at most
constexpr double kFallen = 0.7; ///< share of the failed cost: below it the load counts as fallen
constexpr double kDearest = 8;  ///< most budgets that a failed trial counts
constexpr double kGrown = 1.1;  ///< times the measured cost: above it the load counts as grown
constexpr double kRoom = 0.75;  ///< share of the budget below which motion takes up a footprint
constexpr double kLeast = 0.95; ///< share of the budget above which motion leaves it again

/// Measurements of quads, before others are not tried because of a multiple of them.
constexpr unsigned kSure = 3;

/// Most budgets that a trial may take if nothing but the time since the last trial speaks for it.
constexpr double kBounded = 3;

/// Assumed upper limits of the footprints' times, as multiples of quads, until they are measured:
/// far above the multiples of any GPU, and close to what software GL takes.
constexpr std::array<double, render::kFootprints> kAtMost{1, 8, 5, 12};

constexpr std::size_t rung(Footprint footprint) {
    return static_cast<std::size_t>(footprint);
}

/// The next better footprint that is available; `footprint` itself if there is none.
constexpr Footprint next_better(Footprint footprint, const render::FootprintSet& available) {
    for (int i = static_cast<int>(footprint) + 1; i <= static_cast<int>(render::kBestFootprint);
         ++i)
        if (available.has(static_cast<Footprint>(i)))
            return static_cast<Footprint>(i);
    return footprint;
}
/// The next coarser footprint that is available. @param footprint not quads
constexpr Footprint next_coarser(Footprint footprint, const render::FootprintSet& available) {
    return available.best(static_cast<Footprint>(static_cast<int>(footprint) - 1));
}

} // namespace

/// Chooses by what was measured, and changes a copy of what was tried.
class QualityController::Rule {
  public:
    Rule(const QualityController& controller, const QualityInput& input)
        : trials(controller.trials_), controller_(controller), budget_(controller.budget_),
          input_(input) {}

    QualityChoice choice();
    bool surface_is_guessed() const;

    Trials trials;

  private:
    Candidate& of(Footprint footprint) { return trials.candidates[rung(footprint)]; }
    const Candidate& of(Footprint footprint) const { return trials.candidates[rung(footprint)]; }
    /// Expected; empty before the first measurement.
    auto time_of(Footprint footprint, const DrawLoad& load) const {
        return controller_.expected(footprint, load);
    }
    auto time_of(Footprint footprint) const { return time_of(footprint, input_.load); }
    bool moves() const { return input_.pace == Pace::moving; }

    QualityChoice regardless(Footprint footprint, QualityReason reason);
    QualityChoice within_budget();
    QualityChoice describe() const;
    void turn_to(Footprint footprint);
    void step_down();
    void step_up();
    std::optional<Milliseconds> before(Footprint footprint) const;
    bool has_room() const;
    bool bearable(Footprint footprint) const;
    bool outgrown(Footprint footprint) const;
    bool returns(Footprint footprint);
    bool decided(Footprint footprint) const;
    void fail(Footprint footprint, const DrawLoad& load, Milliseconds cost);

    const QualityController& controller_;
    const Milliseconds budget_;
    const QualityInput& input_;
};

void QualityController::measured(Footprint footprint, const DrawLoad& load, Milliseconds cost) {
    if (load.cells <= 0) // tells what any picture costs
        return costs(Footprint::quad).cost.add(load, cost);
    Candidate& candidate = of(footprint);
    const bool first = !candidate.known && !candidate.failed;
    if (std::exchange(sampled_, footprint) != footprint && !candidate.outdated &&
        (first || cost > budget_)) {
        candidate.sampled.reset(); // to be measured again
        return;
    }
    learn(footprint, load, cost);
    if (footprint != trials_.current)
        return; // a late result of a footprint that was left since: only noted
    candidate.fits = cost <= budget_;
    if (candidate.fits)
        candidate.failed = false;
    trials_.over = (trials_.budgeted && trials_.over) || !candidate.fits;
    if (!candidate.fits) {
        trials_.over_load = load;
        trials_.over_cost = cost;
    }
}

void QualityController::measured_in_parts(Footprint footprint, const DrawLoad& load,
                                          Milliseconds cost) {
    if (load.cells <= 0)
        return;
    Candidate& candidate = of(footprint);
    candidate.outdated |= candidate.age >= kLongestWait;
    learn(footprint, load, cost);
}

void QualityController::learn(Footprint footprint, const DrawLoad& load, Milliseconds cost) {
    Candidate& candidate = of(footprint);
    Costs& known = costs(footprint);
    // Drivers compile for the first pictures, not for the first one alone.
    if (candidate.sampled == load && 2 * cost < *known.cost.predict(load))
        candidate.outdated = true;
    if (std::exchange(candidate.outdated, false)) {
        known.cost.forget();
        known.beside.forget();
        known.measurements = 0;
    }
    ++known.measurements;
    known.cost.add(load, cost);
    if (const auto quads = expected(Footprint::quad, load))
        known.beside.add(load, *quads);
    candidate.sampled = load;
    candidate.known = true;
    candidate.age = 0;
}

bool QualityController::surface_is_guessed(const QualityInput& input) const {
    return Rule(*this, input).surface_is_guessed();
}

QualityChoice QualityController::choose(const QualityInput& input) const {
    return Rule(*this, input).choice();
}

QualityChoice QualityController::advance(const QualityInput& input) {
    Rule rule(*this, input);
    const QualityChoice choice = rule.choice();
    trials_ = rule.trials;
    trials_.was_moving = input.pace == Pace::moving;
    return choice;
}

bool QualityController::Rule::surface_is_guessed() const {
    const Candidate& candidate = of(Footprint::surface);
    const bool guessed = (!candidate.known && !candidate.failed) || candidate.age >= kLongestWait;
    return input_.mode == QualityMode::automatic && !input_.by_pace && input_.load.cells > 0 &&
           input_.available.has(Footprint::surface) && trials.current < Footprint::surface &&
           guessed && time_of(Footprint::quad) && !bearable(Footprint::surface);
}

/// The expected cost of a footprint that is not drawn now, from its earlier times.
std::optional<Milliseconds> QualityController::Rule::before(Footprint footprint) const {
    const Candidate& candidate = of(footprint);
    std::optional<Milliseconds> cost = time_of(footprint);
    if (!cost)
        return cost;
    const bool bounded = candidate.failed && *cost <= kBounded * budget_;
    const auto quads = time_of(Footprint::quad);
    const auto then = controller_.costs(footprint).beside.predict(input_.load);
    if (quads && then && *quads < *then)
        *cost *= *quads / *then;
    if (bounded)
        *cost *= std::exp2(-static_cast<double>(candidate.age) / kLongestWait);
    return cost;
}

QualityChoice QualityController::Rule::choice() {
    trials.since_down = std::min(trials.since_down + 1, kShortestWait);
    if (input_.mode == QualityMode::fast)
        return regardless(Footprint::quad, QualityReason::fast_mode);
    const bool paper = input_.mode == QualityMode::paper;
    if (moves() && (input_.by_pace || paper || input_.load.cells <= 0))
        return regardless(Footprint::quad, QualityReason::moving);
    if (paper)
        return regardless(input_.available.best(Footprint::gaussian), QualityReason::paper_mode);
    if (input_.settled && !moves())
        return regardless(input_.available.best(*input_.settled), QualityReason::configured);
    if (input_.load.cells <= 0) // all footprints look the same; start anew with the next set
        return regardless(Footprint::quad, QualityReason::fits);
    if (input_.mode == QualityMode::quality)
        return regardless(input_.available.best(), QualityReason::quality_mode);
    return within_budget();
}

QualityChoice QualityController::Rule::regardless(Footprint footprint, QualityReason reason) {
    turn_to(footprint);
    trials.budgeted = false;
    return {.footprint = footprint,
            .reason = reason,
            .final = reason != QualityReason::moving,
            .measure = false,
            .cost = time_of(footprint),
            .better_cost = {}};
}

QualityChoice QualityController::Rule::within_budget() {
    turn_to(input_.available.best(trials.current));
    trials.budgeted = true;
    for (Candidate& candidate : trials.candidates)
        if (&candidate != &of(trials.current))
            ++candidate.age;
    if (Candidate& now = of(trials.current); trials.current == Footprint::quad) {
        step_up();
    } else if ((!now.known && !bearable(trials.current)) ||
               (!trials.over && moves() && !has_room())) {
        // Not a failure: it was a trial of fewer cells, or a picture at rest may use it again.
        step_down();
    } else if (trials.over || outgrown(trials.current)) {
        if (trials.over)
            fail(trials.current, trials.over_load, trials.over_cost);
        else
            fail(trials.current, input_.load, *time_of(trials.current));
        step_down();
    } else {
        if (++now.lasted == kProven)
            now.wait = kShortestWait / 2;
        step_up();
    }
    return describe();
}

void QualityController::Rule::turn_to(Footprint footprint) {
    if (footprint == trials.current)
        return;
    trials.current = footprint;
    trials.over = false;
    of(footprint).lasted = 0;
}

/// Turns to the best coarser footprint that is expected to fit or, at rest, was never tried.
void QualityController::Rule::step_down() {
    trials.since_down = 0;
    Footprint to = next_coarser(trials.current, input_.available);
    for (; to != Footprint::quad; to = next_coarser(to, input_.available)) {
        const Candidate& candidate = of(to);
        const auto expected = time_of(to);
        const double share = moves() ? kRoom : 1.0;
        const bool unknown = !expected && !moves();
        if (!candidate.failed && (unknown || (expected && *expected <= share * budget_)))
            break;
    }
    turn_to(to);
}

void QualityController::Rule::step_up() {
    if (trials.since_down < kShortestWait)
        return;
    for (Footprint to = input_.available.best(); to != trials.current;
         to = next_coarser(to, input_.available))
        if (returns(to))
            return turn_to(to);
}

/// Whether the current footprint leaves enough of the budget for a moving picture.
bool QualityController::Rule::has_room() const {
    const Candidate& now = of(trials.current);
    const double share = trials.was_moving ? kLeast : kRoom;
    return now.known ? *time_of(trials.current) <= share * budget_ : bearable(trials.current);
}

/// Whether a frame with this footprint may be drawn to measure it.
bool QualityController::Rule::bearable(Footprint footprint) const {
    const auto quads = time_of(Footprint::quad);
    if (!quads)
        return false; // quads are measured first
    Milliseconds most = kAtMost[rung(footprint)] * *quads;
    if (const auto earlier = before(footprint))
        most = std::min(most, *earlier);
    if (moves())
        return most <= kRoom * budget_;
    // Where the exact picture comes in parts, no frame need be long.
    return most <= (input_.in_parts ? budget_ : std::max(budget_, kDearestTrial));
}

/// Whether the load has grown so much that the next frame is expected over the budget.
bool QualityController::Rule::outgrown(Footprint footprint) const {
    const Candidate& candidate = of(footprint);
    if (!candidate.known || !candidate.sampled || input_.load == candidate.sampled)
        return false;
    const Milliseconds expected = *time_of(footprint);
    return expected > budget_ && expected > kGrown * *time_of(footprint, *candidate.sampled);
}

/// Whether a better footprint than the current one may be drawn now.
bool QualityController::Rule::returns(Footprint footprint) {
    Candidate& candidate = of(footprint);
    if (!candidate.known && !candidate.failed) {
        // Try them from coarse to fine, so that the first frame over the budget is not one with the
        // slowest footprint.
        const Footprint below = next_coarser(footprint, input_.available);
        return bearable(footprint) &&
               (below == Footprint::quad || decided(below) || !bearable(below));
    }
    const auto expected = time_of(footprint);
    // It failed at a larger load: it may return soon.
    const bool fallen = candidate.failed && expected &&
                        *expected <= kFallen * *time_of(footprint, candidate.failed_at);
    if (fallen) {
        candidate.failed_at = input_.load;
        candidate.wait = kShortestWait / 2;
    }
    const double share = moves() ? kRoom : candidate.fits ? 1.0 : kMargin;
    if ((fallen || !candidate.failed) && expected && *expected <= share * budget_)
        return true;
    if (candidate.age < std::max(candidate.wait, kShortestWait) || !bearable(footprint))
        return false;
    candidate.sampled.reset();
    candidate.outdated = true;
    candidate.known = false;
    candidate.fits = false;
    return true;
}

/// Whether it is known if the footprint fits.
bool QualityController::Rule::decided(Footprint footprint) const {
    const Candidate& candidate = of(footprint);
    // The current footprint counts as decided, too, if another picture has told its cost: it may
    // not be drawn again.
    return candidate.fits || candidate.failed ||
           (candidate.known &&
            (footprint == trials.current || *time_of(footprint) > kMargin * budget_));
}

void QualityController::Rule::fail(Footprint footprint, const DrawLoad& load, Milliseconds cost) {
    Candidate& candidate = of(footprint);
    // Keep the least failed load, so that a varying number of cells is no reason to try again.
    if (!candidate.failed || *time_of(footprint, load) < *time_of(footprint, candidate.failed_at))
        candidate.failed_at = load;
    candidate.failed = true;
    candidate.fits = false;
    candidate.failed_cost = cost;
    candidate.age = 0;
    // A footprint that has lasted for a while may have failed by accident. A failed trial that took
    // several budgets is followed by a longer wait.
    const double dear =
        candidate.lasted < kShortestWait ? std::clamp(cost / budget_, 1.0, kDearest) : 1.0;
    candidate.wait = static_cast<unsigned>(
        std::min(2.0 * dear * candidate.wait, static_cast<double>(kLongestWait)));
}

QualityChoice QualityController::Rule::describe() const {
    const Candidate& now = of(trials.current);
    // Nothing is coarser than quads, so it is enough to know the time of quads at any load.
    const bool measured_here = trials.current == Footprint::quad
                                   ? time_of(trials.current).has_value()
                                   : now.sampled == input_.load;
    QualityChoice choice;
    choice.footprint = trials.current;
    choice.reason = trials.current == input_.available.best() ? QualityReason::fits
                                                              : QualityReason::over_budget;
    choice.final = measured_here || (input_.playing && now.fits);
    choice.measure = !measured_here;
    choice.cost = time_of(trials.current);
    for (Footprint better = trials.current; better != input_.available.best();) {
        better = next_better(better, input_.available);
        if (!decided(better) && (bearable(better) || !time_of(Footprint::quad)))
            choice.final = false;
        const Candidate& candidate = of(better);
        if (trials.current == Footprint::quad &&
            controller_.costs(Footprint::quad).measurements < kSure && !time_of(better) &&
            !bearable(better)) {
            choice.final = false;
            choice.measure = true;
        }
        choice.retries |= candidate.failed && bearable(better) &&
                          std::max(candidate.wait, kShortestWait) <= candidate.age + kSoon;
        if (!choice.better_cost)
            choice.better_cost = candidate.failed ? candidate.failed_cost : time_of(better);
    }
    if (!choice.final)
        choice.reason = QualityReason::trial;
    if (moves()) {
        choice.reason = QualityReason::moving;
        choice.final = choice.measure = choice.retries = false;
    }
    return choice;
}

} // namespace isochron::app
