// The error of normals that are stored once for a time span.
#pragma once

#include "index/step_values.h"
#include "index/thi_tree.h"

namespace isochron::app::bench {

/// Angles between the normal of an active cell at its step and that of the same cell in the middle
/// of the time span for which the tree stores it once, as the paper stores position and gradient.
struct NormalError {
    double mean_degrees = 0, p99_degrees = 0;
};

/// Over all steps at one isovalue; cells whose gradient vanishes at either step do not count.
NormalError normal_error(const index::StepValues& values, const index::ThiTree& tree,
                         double isovalue);

} // namespace isochron::app::bench
