// Lets the processes of a cluster agree on the set of cells that they all show.
//
// Every process extracts and uploads its own cells. Queries are numbered in the order of asking.
// With every frame rank 0 sends three numbers: the query to ask, the one to upload and
// the one to show. So all processes ask the same query and switch to a new set in the same frame.
// No process waits: until all of them have a set on their GPUs, all show the previous one.
#pragma once

#include "index/extraction/extraction.h"
#include "index/extraction/extractor.h"

#include <cstdint>
#include <optional>
#include <span>

namespace isochron::app {

/// Numbers of queries, from 1; 0 before the first.
struct CellOrder {
    std::uint64_t ask = 1;   ///< number of the next query, unless it has been asked already
    std::uint64_t stage = 0; ///< query whose cells are uploaded without being shown yet
    std::uint64_t show = 0;  ///< query whose cells are shown
    bool operator==(const CellOrder&) const = default;
};

/// How far a process has come, as numbers of queries.
struct CellProgress {
    std::uint64_t asked = 0;  ///< newest query asked
    std::uint64_t found = 0;  ///< newest query whose cells were extracted
    std::uint64_t failed = 0; ///< newest query that failed
    std::uint64_t staged = 0; ///< newest query whose cells are completely on the GPU
    bool operator==(const CellProgress&) const = default;
};

/// Rank 0's side: decides what all processes ask, upload and show.
class CellAgreement {
  public:
    /// Called once per frame. @param all progress of every process in the previous frame
    const CellOrder& decide(std::span<const CellProgress> all);

  private:
    CellOrder order_;
};

/// Every process's side: obeys the orders and reports the progress.
class SharedCells {
  public:
    void obey(const CellOrder& order);

    /// @return the query to extract: `wanted` once the order allows a new query, else the last one
    const index::SurfacesQuery& ask(const index::SurfacesQuery& wanted);
    /// Notes whether the extractor has found the cells of the newest query, or failed.
    void look_at(const index::Extractor& extractor);

    /// The set to show; null before the first one.
    const index::ExtractionPtr& to_show() const { return showing_; }
    /// The set to upload next; null if there is none or it is already on the GPU.
    index::ExtractionPtr to_stage() const;
    void staged() { progress_.staged = order_.stage; }

    const CellProgress& progress() const { return progress_; }

  private:
    CellOrder order_;
    CellProgress progress_;
    std::optional<index::SurfacesQuery> query_;
    index::ExtractionPtr found_, staging_, showing_;
};

} // namespace isochron::app
