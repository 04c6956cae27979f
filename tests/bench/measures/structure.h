// A search structure for the benchmark: its costs, and the operations that it has.
#pragma once

#include "index/paper/thi_entries.h"
#include "index/surface/cell_set.h"
#include "index/volume/query.h"
#include "tests/bench/rivals/span_normals.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace isochron::bench {

using Ids = std::vector<index::CellId>;

/// Functions that a structure lacks stay empty; their figures are null. All calls come from one
/// thread. The functions keep the data that they search alive.
struct Structure {
    std::string name;                     ///< as in the rows: `thi`, `bricks`, ...
    std::optional<index::ThiOptions> thi; ///< options of the paper's structure and its variants
    std::uint64_t bytes = 0;              ///< without the volume
    std::uint64_t entries = 0;            ///< stored (cell, interval, time node), if it has these
    bool candidates = false;              ///< its results still need the exact test
    unsigned build_threads = 1;
    double build_seconds = 0; ///< processor time of all threads; 0 if nothing is built

    /// Replaces the ids by the cells of a full search, in any order, each once.
    std::function<void(const index::Query&, Ids&)> ids;
    /// Ids, positions and normals of the active cells; if this is empty, they are made from `ids`.
    std::function<void(const index::Query&, index::CellSet&)> full;
    /// Updates the set of the last query to that of this one. @return its size
    std::function<std::size_t(const index::Query&)> follow;
    /// The error of normals that are stored once for a time span, at an isovalue.
    std::function<NormalError(double isovalue)> normal_error;
};

} // namespace isochron::bench
