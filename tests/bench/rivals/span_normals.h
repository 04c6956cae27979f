// The error of normals that are stored once for a time span.
#pragma once

#include "index/paper/thi_tree.h"
#include "index/volume/query.h"
#include "index/volume/step_values.h"

#include <cstdint>
#include <vector>

namespace isochron::bench {

/// The active cells of a time node of the tree, which stores them once for its whole span.
struct SpanCells {
    std::uint32_t middle = 0;         ///< step in the middle of the span
    std::vector<index::CellId> cells; ///< in no particular order
};

/// The active cells by the time node in which the tree found them, from the root down.
std::vector<SpanCells> span_cells(const index::StepValues& values, const index::ThiTree& tree,
                                  const index::Query& query);

/// Angles between an active cell's normal at its step and the same cell's normal in the middle of
/// the time span for which the tree stores the cell once, as in the paper.
struct NormalError {
    double mean_degrees = 0, p99_degrees = 0;
};

/// The error over all steps at one isovalue, without cells whose gradient is zero at either step.
NormalError normal_error(const index::StepValues& values, const index::ThiTree& tree,
                         double isovalue);

} // namespace isochron::bench
