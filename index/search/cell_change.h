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

/// Finds changes in the cheapest way that the index allows: in the chunks that differ between two
/// steps if at least half of the chunks stay, else by a full search for the second query. Not
/// thread-safe: keeps its work space.
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
    std::optional<CellChange> where_chunks_change(const Query& from, const Query& to);
    std::shared_ptr<const IndexFile> file_;
    std::unique_ptr<WorkSpace> work_;
};

} // namespace isochron::index
