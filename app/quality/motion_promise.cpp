// The time that is promised for each moving picture.
#include "app/quality/motion_promise.h"

#include <algorithm>

namespace isochron::app {
namespace {

/// A promise stays while it is at most this many times as long as needed: times scatter.
constexpr double kStays = 1.3;
/// A new promise is so much longer than needed, so that a little more is no reason for another one.
constexpr double kSpare = 1.1;

} // namespace

Milliseconds MotionPromise::needed(const MotionCosts& costs, double cells, double share) {
    return costs.beside + share * (costs.fixed + cells * costs.of_cell) / kRoom;
}

void MotionPromise::update(const std::optional<MotionCosts>& costs,
                           std::optional<std::uint64_t> cells, interaction::Seconds now) {
    if (!costs || !cells || *cells == 0)
        return;
    const auto all = static_cast<double>(*cells);
    const auto within = [this](Milliseconds time, Milliseconds limit) {
        return std::clamp(time, wanted_, std::max(wanted_, limit));
    };
    const auto wish = [&](double spare) {
        return std::max(
            within(spare * needed(*costs, all), limits_.all),
            within(spare * needed(*costs, kLeastShare * all, costs->few_pixels), limits_.least));
    };
    const Milliseconds least = wish(1);
    if (time() < least || time() > std::max(wanted_, kStays * least))
        time_.turn(wish(kSpare), now);
}

std::uint64_t least_recognized(std::optional<std::uint64_t> cells) {
    return static_cast<std::uint64_t>(MotionPromise::kLeastShare *
                                      static_cast<double>(cells.value_or(0)));
}

} // namespace isochron::app
