// Chooses the footprint of a frame by what drawing has cost.
#include "app/frame/quality_controller.h"

#include <algorithm>
#include <array>
#include <utility>

namespace isochron::app {
namespace {

using interaction::Pace;
using interaction::QualityMode;
using render::Footprint;

constexpr double kMargin = 0.8; ///< of the budget: what does not yet run is expected below it
constexpr double kFallen = 0.7; ///< of the cost that failed: below it another load is at hand
constexpr double kDearest = 8;  ///< budgets that a failed trial is reckoned at, at most
constexpr double kGrown = 1.1;  ///< of the cost that was measured: likewise above it
constexpr double kRoom = 0.75;  ///< of the budget: what moves comes to a footprint below it,
constexpr double kLeast = 0.95; ///< and leaves it above it

/// What footprints take at most, as a multiple of quads, until they are measured. By far more than
/// they take on any GPU; software GL comes near.
constexpr std::array<double, render::kFootprints> kAtMost{1, 8, 5, 12};

/// None of the cells' footprints is better: the best itself.
constexpr Footprint next_better(Footprint footprint, const render::FootprintSet& available) {
    for (int i = static_cast<int>(footprint) + 1; i <= static_cast<int>(render::kBestFootprint);
         ++i)
        if (available.has(static_cast<Footprint>(i)))
            return static_cast<Footprint>(i);
    return footprint;
}
/// Of a footprint that is not quads.
constexpr Footprint next_coarser(Footprint footprint, const render::FootprintSet& available) {
    return available.best(static_cast<Footprint>(static_cast<int>(footprint) - 1));
}

} // namespace

const char* name_of(QualityReason reason) {
    switch (reason) {
    case QualityReason::moving: return "moving";
    case QualityReason::fast_mode: return "fast mode";
    case QualityReason::best_mode: return "best mode";
    case QualityReason::paper_mode: return "paper mode";
    case QualityReason::configured: return "configured";
    case QualityReason::fits: return "fits";
    case QualityReason::trial: return "trial";
    case QualityReason::over_budget: break;
    }
    return "over budget";
}

void QualityController::measured(Footprint footprint, const DrawLoad& load, Milliseconds cost) {
    if (load.cells <= 0)
        return; // what it takes to draw nothing says nothing of cells
    Candidate& candidate = of(footprint);
    const bool first = !candidate.known && !candidate.failed;
    if (std::exchange(sampled_, footprint) != footprint && (first || cost > budget_)) {
        candidate.sampled.reset(); // to be measured again
        return;
    }
    candidate.cost.add(load, cost);
    candidate.sampled = load;
    candidate.known = true;
    candidate.age = 0;
    if (footprint != current_)
        return; // a late one of what was left since: news, but no verdict
    candidate.fits = cost <= budget_;
    if (candidate.fits)
        candidate.failed = false;
    over_ = (budgeted_ && over_) || !candidate.fits;
    if (!candidate.fits) {
        over_load_ = load;
        over_cost_ = cost;
    }
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
    if (input.load.cells <= 0) // every footprint shows the same; the next set is met as new
        return regardless(Footprint::quad, QualityReason::fits, input.load);
    if (input.mode == QualityMode::quality && !input.playing)
        return regardless(input.available.best(), QualityReason::best_mode, input.load);
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
    } else if (!over_ && input.pace == Pace::moving && !has_room(input)) {
        step_down(input); // it has not failed: a picture at rest may take it up again
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

/// To the best one that is known to fit or was never tried.
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

/// Whether the present footprint leaves room for what a moving picture may bring.
bool QualityController::has_room(const QualityInput& input) const {
    const auto expected = of(current_).cost.predict(input.load);
    const double share = was_moving_ ? kLeast : kRoom;
    return expected ? *expected <= share * budget_ : bearable(current_, input);
}

/// Whether a frame of this footprint may be drawn to learn what it takes.
bool QualityController::bearable(Footprint footprint, const QualityInput& input) const {
    const auto quads = of(Footprint::quad).cost.predict(input.load);
    if (!quads)
        return false; // they are measured first
    Milliseconds most = kAtMost[static_cast<std::size_t>(footprint)] * *quads;
    if (const auto before = of(footprint).cost.predict(input.load))
        most = std::min(most, *before);
    return most <=
           (input.pace == Pace::moving ? kRoom * budget_ : std::max(budget_, kDearestTrial));
}

/// Whether the cells have changed so much that the next frame is expected over the budget.
bool QualityController::outgrown(const Candidate& candidate, const DrawLoad& load) const {
    if (!candidate.known || !candidate.sampled || load == candidate.sampled)
        return false;
    const Milliseconds expected = *candidate.cost.predict(load);
    return expected > budget_ && expected > kGrown * *candidate.cost.predict(*candidate.sampled);
}

/// Whether a better footprint than the present one may be drawn now.
bool QualityController::returns(Footprint footprint, const QualityInput& input) {
    const DrawLoad& load = input.load;
    Candidate& candidate = of(footprint);
    if (!candidate.known && !candidate.failed) {
        // One after the other, from the fastest, so that the first frame over the budget is not
        // that of the slowest.
        const Footprint below = next_coarser(footprint, input.available);
        return bearable(footprint, input) &&
               (below == Footprint::quad || decided(below, input) || !bearable(below, input));
    }
    const auto expected = candidate.cost.predict(load);
    // The bad news was of another load, and is forgotten soon.
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
    candidate.cost.forget();
    candidate.sampled.reset();
    candidate.known = false;
    candidate.fits = false;
    return true;
}

/// Whether it is known that the footprint fits, or that it does not.
bool QualityController::decided(Footprint footprint, const QualityInput& input) const {
    const Candidate& candidate = of(footprint);
    // The present one may be known from another picture, and not be drawn again.
    return candidate.fits || candidate.failed ||
           (candidate.known &&
            (footprint == current_ || *candidate.cost.predict(input.load) > kMargin * budget_));
}

void QualityController::fail(Candidate& candidate, const DrawLoad& load, Milliseconds cost) const {
    // Of several loads the least, so that cells that vary are no reason to try again.
    if (!candidate.failed ||
        *candidate.cost.predict(load) < *candidate.cost.predict(candidate.failed_at))
        candidate.failed_at = load;
    candidate.failed = true;
    candidate.fits = false;
    candidate.failed_cost = cost;
    candidate.age = 0;
    // One that has lasted may have met an accident; a trial that took several budgets is dear.
    const double dear =
        candidate.lasted < kShortestWait ? std::clamp(cost / budget_, 1.0, kDearest) : 1.0;
    candidate.wait = static_cast<unsigned>(
        std::min(2.0 * dear * candidate.wait, static_cast<double>(kLongestWait)));
}

QualityChoice QualityController::describe(const QualityInput& input) const {
    const Candidate& now = of(current_);
    // Quads are what is left: it is enough to know what they take at some load.
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
        if (!choice.better_cost)
            choice.better_cost =
                of(better).failed ? of(better).failed_cost : of(better).cost.predict(input.load);
    }
    if (!choice.final)
        choice.reason = QualityReason::trial;
    if (input.pace == Pace::moving) {
        choice.reason = QualityReason::moving;
        choice.final = choice.measure = false;
    }
    return choice;
}

} // namespace isochron::app
