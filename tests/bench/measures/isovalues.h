// Which isovalues a series is measured at.
#pragma once

#include "index/volume/step_values.h"

#include <vector>

namespace isochron::bench {

/// The quantiles k / (count + 1) of the numbers among the scaled values of all steps, k = 1 to
/// `count`; of large series those of an even sample. Empty when there are no numbers.
std::vector<double> quantile_isovalues(const index::StepValues& values, int count);

/// The highest isovalue at which about so many cells are active on average over some of the steps,
/// with few digits; where no isovalue has as many, one that has most.
double isovalue_with(const index::StepValues& values, double active);

} // namespace isochron::bench
