// How long it takes until what was asked for is shown.
#include "tests/bench/motion/asked_shown.h"

#include "tests/bench/measures/render_measure.h"

namespace isochron::bench {

std::optional<double> AskedShown::percentile(double percent) const {
    if (milliseconds_.empty())
        return std::nullopt;
    return bench::percentile(milliseconds_, percent);
}

} // namespace isochron::bench
