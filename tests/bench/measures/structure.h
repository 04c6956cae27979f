// A search structure as the benchmark sees it: what it costs and what it can be asked.
#pragma once

#include "index/extraction/cell_set.h"
#include "index/thi/thi_entries.h"
#include "index/volume/query.h"
#include "tests/bench/rivals/span_normals.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace isochron::bench {

using Ids = std::vector<index::CellId>;

/// What a structure has no way to do stays empty, and its figure null. All calls come from one
/// thread; what they capture keeps alive what they search.
struct Structure {
    std::string name;                     ///< as in the rows: `thi`, `bricks`, ...
    std::optional<index::ThiOptions> thi; ///< of the paper's structure and its variants
    std::uint64_t bytes = 0;              ///< without the volume
    std::uint64_t entries = 0;            ///< stored (cell, interval, time node), where it has such
    bool candidates = false;              ///< its answers still want the exact test
    unsigned build_threads = 1;
    double build_seconds = 0; ///< of processor time, over all threads; 0 where nothing is built

    /// Appends the cells of a full search, in any order, each once.
    std::function<void(const index::Query&, Ids&)> ids;
    /// A full search that leaves the ids where they lie. @return the number of runs
    std::function<std::size_t(const index::Query&)> runs;
    /// Ids, positions and normals of the active cells; made from `ids` where it is empty.
    std::function<void(const index::Query&, index::CellSet&)> full;
    /// Finds the ids that come and those that go between two queries, without knowing anything
    /// else. @return how many
    std::function<std::size_t(const index::Query& from, const index::Query& to)> change;
    /// Moves on from the last query it was given, to the complete new set. @return its size
    std::function<std::size_t(const index::Query&)> follow;
    /// The error of normals that are stored once for a time span, at an isovalue.
    std::function<NormalError(double isovalue)> normal_error;
};

} // namespace isochron::bench
