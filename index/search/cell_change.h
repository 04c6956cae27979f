// Incremental search: finds the changes in the set of active cells from one query to another.
#pragma once

#include "index/file/index_file.h"
#include "index/volume/query.h"

#include <memory>
#include <optional>
#include <span>

namespace isochron::index {

/// The changes that turn the active cells of the first query into the active cells of the second.
struct CellChange {
    /// True if few cells stay: then `added` holds all cells of the second query, and all cells of
    /// the first are dropped.
    bool whole = false;
    std::span<const CellId> added, removed; ///< unordered, each cell once
};

/// Finds changes in the cheapest way that the index allows: by the deltas of a transition, the
/// levels between two isovalues, the time nodes that two steps do not share, the chunks that differ
/// between two steps, or a full search for the second query. It chooses the way that moves the fewest ids, so that a change never costs
/// more than a full search. Not thread-safe: keeps its work space.
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
    std::optional<CellChange> where_chunks_change(const Query& from, const Query& to);
    std::shared_ptr<const IndexFile> file_;
    std::unique_ptr<WorkSpace> work_;
};

} // namespace isochron::index
