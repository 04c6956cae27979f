// Agreement of several processes on the cells that all of them show.
//
// Every process extracts and uploads for itself. A query gets a number when it is asked; the
// numbers up to which a query may be asked, uploaded and shown go out with every frame, so that all
// ask for the same, and another set appears in the same frame everywhere. Nobody ever waits: until
// the last one holds a set, all show the one before.
#pragma once

#include "index/extraction/extraction.h"
#include "index/extraction/extractor.h"

#include <cstdint>
#include <optional>
#include <span>

namespace isochron::app {

/// Numbers of queries, from 1; 0 before the first.
struct CellOrder {
    std::uint64_t ask = 1;   ///< the next query gets this number, unless it has been asked already
    std::uint64_t stage = 0; ///< is uploaded, and not shown yet
    std::uint64_t show = 0;  ///< is shown
    bool operator==(const CellOrder&) const = default;
};

/// How far a process has got.
struct CellProgress {
    std::uint64_t asked = 0;  ///< newest query
    std::uint64_t found = 0;  ///< newest whose cells are there
    std::uint64_t failed = 0; ///< newest that has no answer
    std::uint64_t staged = 0; ///< newest of which everything is on the GPU
    bool operator==(const CellProgress&) const = default;
};

/// What rank 0 decides.
class CellAgreement {
  public:
    /// Once per frame. @param all of the frame before, of every process
    const CellOrder& decide(std::span<const CellProgress> all);

  private:
    CellOrder order_;
};

/// What a process does about it.
class SharedCells {
  public:
    void obey(const CellOrder& order);

    /// @return the query to work on: the wanted one as soon as the order lets it be asked
    const index::SurfacesQuery& ask(const index::SurfacesQuery& wanted);
    /// Takes note of what the extractor has got.
    void look_at(const index::Extractor& extractor);

    /// The set that is to be shown; null before the first.
    const index::ExtractionPtr& to_show() const { return showing_; }
    /// The set that is to be staged after that; null when there is none, or when it is.
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
