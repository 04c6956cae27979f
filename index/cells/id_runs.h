// Search results as runs: references to ids in the memory of the index.
#pragma once

#include "index/volume/grid.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// The cells `first + ids[0]`, ..., `first + ids[count - 1]` of one stretch. Up to kSlack ids after
/// the run can be read too (they have no meaning), so that it can be copied in whole vectors.
struct IdRun {
    static constexpr std::size_t kSlack = 32;
    const std::uint16_t* ids;
    std::uint32_t count;
    CellId first;
};

/// Appends runs to a vector in bulk, since appending one takes more time than finding one.
class RunBuffer {
  public:
    explicit RunBuffer(std::vector<IdRun>& out) : out_(out) {}
    ~RunBuffer() { flush(); }
    RunBuffer(const RunBuffer&) = delete;
    RunBuffer& operator=(const RunBuffer&) = delete;

    /// Room for `count` runs; then call `took` with the end of those that were written.
    IdRun* room(std::size_t count) {
        if (runs_.size() - size_ < count)
            flush();
        return runs_.data() + size_;
    }
    void took(const IdRun* end) { size_ = static_cast<std::size_t>(end - runs_.data()); }

  private:
    void flush() {
        out_.insert(out_.end(), runs_.data(), runs_.data() + size_);
        size_ = 0;
    }

    std::vector<IdRun>& out_;
    std::size_t size_ = 0;
    std::array<IdRun, 512> runs_;
};

/// Number of cells in the runs.
std::size_t count_ids(std::span<const IdRun> runs);

/// Writes the cells of the runs, in order; up to kSlack ids after them may be overwritten too.
/// @param out must have room for kSlack ids more than the runs have @return number of ids written
std::size_t copy_ids(std::span<const IdRun> runs, std::span<CellId> out);

/// Replaces `out` by the cells of the runs, in order. For a vector that is kept from search to
/// search: only what it grows by is filled with zeros before.
void assign_ids(std::span<const IdRun> runs, std::vector<CellId>& out);

} // namespace isochron::index
