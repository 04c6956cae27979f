// Gaps of a series.
#include "index/volume/step_gaps.h"

#include <algorithm>
#include <span>

namespace isochron::index {

std::vector<std::uint32_t> gaps_of(const SeriesInfo& info, std::size_t steps) {
    const auto times = std::span(info.times).first(steps == 0 ? info.steps() : steps);
    std::vector<std::uint32_t> gaps;
    if (times.size() < 2)
        return gaps;
    std::vector<double> apart;
    for (std::size_t t = 1; t < times.size(); ++t)
        apart.push_back(times[t] - times[t - 1]);
    std::vector<double> sorted = apart;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::ranges::nth_element(sorted, middle);
    constexpr double kMost = 3.0;
    for (std::uint32_t step = 0; step < apart.size(); ++step)
        if (apart[step] > kMost * *middle || std::ranges::binary_search(info.missing_after, step))
            gaps.push_back(step);
    return gaps;
}

} // namespace isochron::index
