// Chooses the footprint of a frame by the measured cost of drawing.
#include "app/quality/quality_controller.h"

#include <algorithm>
#include <array>
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

void QualityController::measured(Footprint footprint, const DrawLoad& load, Milliseconds cost) {
    if (load.cells <= 0) // tells what any picture costs
        return of(Footprint::quad).cost.add(load, cost);
    Candidate& candidate = of(footprint);
    const bool first = !candidate.known && !candidate.failed;
    if (std::exchange(sampled_, footprint) != footprint && !candidate.outdated &&
        (first || cost > budget_)) {
        candidate.sampled.reset(); // to be measured again
        return;
    }
    learn(candidate, load, cost);
    if (footprint != current_)
        return; // a late result of a footprint that was left since: only noted
    candidate.fits = cost <= budget_;
    if (candidate.fits)
        candidate.failed = false;
    over_ = (budgeted_ && over_) || !candidate.fits;
    if (!candidate.fits) {
        over_load_ = load;
        over_cost_ = cost;
    }
}

void QualityController::measured_in_parts(Footprint footprint, const DrawLoad& load,
                                          Milliseconds cost) {
    if (load.cells <= 0)
        return;
    Candidate& candidate = of(footprint);
    candidate.outdated |= candidate.age >= kLongestWait;
    learn(candidate, load, cost);
}

bool QualityController::surface_is_guessed(const QualityInput& input) const {
    const Candidate& candidate = of(Footprint::surface);
    const bool guessed = (!candidate.known && !candidate.failed) || candidate.age >= kLongestWait;
    return input.mode == QualityMode::automatic && !input.by_pace && input.load.cells > 0 &&
           input.available.has(Footprint::surface) && current_ < Footprint::surface && guessed &&
           of(Footprint::quad).cost.predict(input.load) && !bearable(Footprint::surface, input);
}

void QualityController::learn(Candidate& candidate, const DrawLoad& load, Milliseconds cost) const {
    // Drivers compile for the first pictures, not for the first one alone.
    if (candidate.sampled == load && 2 * cost < *candidate.cost.predict(load))
        candidate.outdated = true;
    if (std::exchange(candidate.outdated, false)) {
        candidate.cost.forget();
        candidate.beside.forget();
        candidate.measurements = 0;
    }
    ++candidate.measurements;
    candidate.cost.add(load, cost);
    if (const auto quads = of(Footprint::quad).cost.predict(load))
        candidate.beside.add(load, *quads);
    candidate.sampled = load;
    candidate.known = true;
    candidate.age = 0;
}

/// The expected cost of a footprint that is not drawn now, from its earlier times.
std::optional<Milliseconds> QualityController::before(Footprint footprint,
                                                      const DrawLoad& load) const {
    const Candidate& candidate = of(footprint);
    std::optional<Milliseconds> cost = candidate.cost.predict(load);
    if (!cost)
        return cost;
    const bool bounded = candidate.failed && *cost <= kBounded * budget_;
    const auto quads = of(Footprint::quad).cost.predict(load);
    const auto then = candidate.beside.predict(load);
    if (quads && then && *quads < *then)
        *cost *= *quads / *then;
    if (bounded)
        *cost *= std::exp2(-static_cast<double>(candidate.age) / kLongestWait);
    return cost;
}

QualityChoice QualityController::choose(const QualityInput& input) {
    since_down_ = std::min(since_down_ + 1, kShortestWait);
    const QualityChoice choice = choice_for(input);
    was_moving_ = input.pace == Pace::moving;
    return choice;
}

QualityChoice QualityController::choice_for(const QualityInput& input) {
    if (input.mode == QualityMode::fast)
        return regardless(Footprint::quad, QualityReason::fast_mode, input.load);
    const bool paper = input.mode == QualityMode::paper;
    if (input.pace == Pace::moving && (input.by_pace || paper || input.load.cells <= 0))
        return regardless(Footprint::quad, QualityReason::moving, input.load);
    if (paper)
        return regardless(input.available.best(Footprint::gaussian), QualityReason::paper_mode,
                          input.load);
    if (input.settled && input.pace != Pace::moving)
        return regardless(input.available.best(*input.settled), QualityReason::configured,
                          input.load);
    if (input.load.cells <= 0) // all footprints look the same; start anew with the next set
        return regardless(Footprint::quad, QualityReason::fits, input.load);
    if (input.mode == QualityMode::quality)
        return regardless(input.available.best(), QualityReason::quality_mode, input.load);
    return within_budget(input);
}

QualityChoice QualityController::regardless(Footprint footprint, QualityReason reason,
                                            const DrawLoad& load) {
    turn_to(footprint);
    budgeted_ = false;
    return {.footprint = footprint,
            .reason = reason,
            .final = reason != QualityReason::moving,
            .measure = false,
            .cost = of(footprint).cost.predict(load),
            .better_cost = {}};
}

QualityChoice QualityController::within_budget(const QualityInput& input) {
    turn_to(input.available.best(current_));
    budgeted_ = true;
    for (Candidate& candidate : candidates_)
        if (&candidate != &of(current_))
            ++candidate.age;
    if (Candidate& now = of(current_); current_ == Footprint::quad) {
        step_up(input);
    } else if ((!now.known && !bearable(current_, input)) ||
               (!over_ && input.pace == Pace::moving && !has_room(input))) {
        // Not a failure: it was a trial of fewer cells, or a picture at rest may use it again.
        step_down(input);
    } else if (over_ || outgrown(now, input.load)) {
        if (over_)
            fail(now, over_load_, over_cost_);
        else
            fail(now, input.load, *now.cost.predict(input.load));
        step_down(input);
    } else {
        if (++now.lasted == kProven)
            now.wait = kShortestWait / 2;
        step_up(input);
    }
    return describe(input);
}

void QualityController::turn_to(Footprint footprint) {
    if (footprint == current_)
        return;
    current_ = footprint;
    over_ = false;
    of(footprint).lasted = 0;
}

/// Turns to the best coarser footprint that is expected to fit or, at rest, was never tried.
void QualityController::step_down(const QualityInput& input) {
    since_down_ = 0;
    Footprint to = next_coarser(current_, input.available);
    for (; to != Footprint::quad; to = next_coarser(to, input.available)) {
        const Candidate& candidate = of(to);
        const auto expected = candidate.cost.predict(input.load);
        const double share = input.pace == Pace::moving ? kRoom : 1.0;
        const bool unknown = !expected && input.pace != Pace::moving;
        if (!candidate.failed && (unknown || (expected && *expected <= share * budget_)))
            break;
    }
    turn_to(to);
}

void QualityController::step_up(const QualityInput& input) {
    if (since_down_ < kShortestWait)
        return;
    for (Footprint to = input.available.best(); to != current_;
         to = next_coarser(to, input.available))
        if (returns(to, input))
            return turn_to(to);
}

/// Whether the current footprint leaves enough of the budget for a moving picture.
bool QualityController::has_room(const QualityInput& input) const {
    const Candidate& now = of(current_);
    const double share = was_moving_ ? kLeast : kRoom;
    return now.known ? *now.cost.predict(input.load) <= share * budget_ : bearable(current_, input);
}

/// Whether a frame with this footprint may be drawn to measure it.
bool QualityController::bearable(Footprint footprint, const QualityInput& input) const {
    const auto quads = of(Footprint::quad).cost.predict(input.load);
    if (!quads)
        return false; // quads are measured first
    Milliseconds most = kAtMost[static_cast<std::size_t>(footprint)] * *quads;
    if (const auto earlier = before(footprint, input.load))
        most = std::min(most, *earlier);
    if (input.pace == Pace::moving)
        return most <= kRoom * budget_;
    // Where the exact picture comes in parts, no frame need be long.
    return most <= (input.in_parts ? budget_ : std::max(budget_, kDearestTrial));
}

/// Whether the load has grown so much that the next frame is expected over the budget.
bool QualityController::outgrown(const Candidate& candidate, const DrawLoad& load) const {
    if (!candidate.known || !candidate.sampled || load == candidate.sampled)
        return false;
    const Milliseconds expected = *candidate.cost.predict(load);
    return expected > budget_ && expected > kGrown * *candidate.cost.predict(*candidate.sampled);
}

/// Whether a better footprint than the current one may be drawn now.
bool QualityController::returns(Footprint footprint, const QualityInput& input) {
    const DrawLoad& load = input.load;
    Candidate& candidate = of(footprint);
    if (!candidate.known && !candidate.failed) {
        // Try them from coarse to fine, so that the first frame over the budget is not one with the
        // slowest footprint.
        const Footprint below = next_coarser(footprint, input.available);
        return bearable(footprint, input) &&
               (below == Footprint::quad || decided(below, input) || !bearable(below, input));
    }
    const auto expected = candidate.cost.predict(load);
    // It failed at a larger load: it may return soon.
    const bool fallen = candidate.failed && expected &&
                        *expected <= kFallen * *candidate.cost.predict(candidate.failed_at);
    if (fallen) {
        candidate.failed_at = load;
        candidate.wait = kShortestWait / 2;
    }
    const double share = input.pace == Pace::moving ? kRoom : candidate.fits ? 1.0 : kMargin;
    if ((fallen || !candidate.failed) && expected && *expected <= share * budget_)
        return true;
    if (candidate.age < std::max(candidate.wait, kShortestWait) || !bearable(footprint, input))
        return false;
    candidate.sampled.reset();
    candidate.outdated = true;
    candidate.known = false;
    candidate.fits = false;
    return true;
}

/// Whether it is known if the footprint fits.
bool QualityController::decided(Footprint footprint, const QualityInput& input) const {
    const Candidate& candidate = of(footprint);
    // The current footprint counts as decided, too, if another picture has told its cost: it may
    // not be drawn again.
    return candidate.fits || candidate.failed ||
           (candidate.known &&
            (footprint == current_ || *candidate.cost.predict(input.load) > kMargin * budget_));
}

void QualityController::fail(Candidate& candidate, const DrawLoad& load, Milliseconds cost) const {
    // Keep the least failed load, so that a varying number of cells is no reason to try again.
    if (!candidate.failed ||
        *candidate.cost.predict(load) < *candidate.cost.predict(candidate.failed_at))
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

QualityChoice QualityController::describe(const QualityInput& input) const {
    const Candidate& now = of(current_);
    // Nothing is coarser than quads, so it is enough to know the time of quads at any load.
    const bool measured_here = current_ == Footprint::quad
                                   ? now.cost.predict(input.load).has_value()
                                   : now.sampled == input.load;
    QualityChoice choice;
    choice.footprint = current_;
    choice.reason =
        current_ == input.available.best() ? QualityReason::fits : QualityReason::over_budget;
    choice.final = measured_here || (input.playing && now.fits);
    choice.measure = !measured_here;
    choice.cost = now.cost.predict(input.load);
    for (Footprint better = current_; better != input.available.best();) {
        better = next_better(better, input.available);
        if (!decided(better, input) &&
            (bearable(better, input) || !of(Footprint::quad).cost.predict(input.load)))
            choice.final = false;
        const Candidate& candidate = of(better);
        if (current_ == Footprint::quad && now.measurements < kSure &&
            !candidate.cost.predict(input.load) && !bearable(better, input)) {
            choice.final = false;
            choice.measure = true;
        }
        choice.retries |= candidate.failed && bearable(better, input) &&
                          std::max(candidate.wait, kShortestWait) <= candidate.age + kSoon;
        if (!choice.better_cost)
            choice.better_cost =
                of(better).failed ? of(better).failed_cost : of(better).cost.predict(input.load);
    }
    if (!choice.final)
        choice.reason = QualityReason::trial;
    if (input.pace == Pace::moving) {
        choice.reason = QualityReason::moving;
        choice.final = choice.measure = choice.retries = false;
    }
    return choice;
}

} // namespace isochron::app
