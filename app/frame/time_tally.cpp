// Summaries of times.
#include "app/frame/time_tally.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace isochron::app {
namespace {

constexpr double kShortest = 1e-3; ///< [ms]
constexpr double kStep = 1.01;
constexpr std::size_t kSteps = 2072; ///< to a quarter of an hour

std::size_t step_of(double milliseconds) {
    if (!(milliseconds > kShortest))
        return 0;
    const double step = std::log(milliseconds / kShortest) / std::log(kStep);
    return std::min(static_cast<std::size_t>(step), kSteps - 1);
}

/// In the middle of a step.
double time_at(std::size_t step) {
    return kShortest * std::pow(kStep, static_cast<double>(step) + 0.5);
}

} // namespace

TimeSummary summarize(std::vector<double> milliseconds) {
    if (milliseconds.empty())
        return {};
    std::sort(milliseconds.begin(), milliseconds.end());
    const std::size_t last = milliseconds.size() - 1;
    return {milliseconds[last / 2], milliseconds[last * 99 / 100], milliseconds[last]};
}

void TimeTally::add(double milliseconds) {
    counts_.resize(kSteps);
    ++counts_[step_of(milliseconds)];
    worst_ = all_ == 0 ? milliseconds : std::max(worst_, milliseconds);
    ++all_;
}

TimeSummary TimeTally::summary() const {
    if (all_ == 0)
        return {};
    const auto at = [&](std::uint64_t number) {
        std::size_t step = 0;
        for (std::uint64_t before = counts_[0]; before <= number;)
            before += counts_[++step];
        return std::min(time_at(step), worst_);
    };
    return {at((all_ - 1) / 2), at((all_ - 1) * 99 / 100), worst_};
}

} // namespace isochron::app
