// Chooses the isovalues at which a series is measured.
#pragma once

#include "index/volume/step_values.h"

#include <vector>

namespace isochron::bench {

/// The quantiles k / (count + 1), k = 1 to `count`, of the scaled values of all steps without NaN;
/// of large series those of an evenly spaced sample. Empty if all values are NaN.
std::vector<double> quantile_isovalues(const index::StepValues& values, int count);

/// The highest isovalue, with few digits, at which about `active` cells are active on average over
/// some of the steps; if no isovalue has that many, the one with the most.
double isovalue_with(const index::StepValues& values, double active);

} // namespace isochron::bench
