// Incremental search: what changes in the set of active cells from one query to another.
#pragma once

#include "index/file/index_file.h"
#include "index/volume/query.h"

#include <memory>
#include <span>

namespace isochron::index {

/// Applied to the active cells of the first query they give those of the second.
struct CellChange {
    /// True where little stays: `added` is all of the second query's cells, and every cell of the
    /// first goes.
    bool whole = false;
    std::span<const CellId> added, removed; ///< in no order, each cell once
};

/// Finds changes with the cheapest of what the index has: the deltas of a transition, the levels
/// between two isovalues, the time nodes that two steps do not share, or the search for the
/// second query alone. Which one is decided by the number of ids that each would move, so that a
/// change never costs more than that search. Not thread-safe: keeps its work space.
class ChangeSearch {
  public:
    explicit ChangeSearch(std::shared_ptr<const IndexFile> file);
    ~ChangeSearch();

    /// The ids stay valid until the next call.
    /// @throws Error when a step is not one of the index's
    CellChange operator()(const Query& from, const Query& to);

  private:
    struct WorkSpace;
    CellChange searched(const Query& to);
    CellChange without_cells(const Query& from, const Query& to);
    std::shared_ptr<const IndexFile> file_;
    std::unique_ptr<WorkSpace> work_;
};

} // namespace isochron::index
