// Builds the cells and the deltas of one stretch in one epoch.
#pragma once

#include "index/cells/cell_table_builder.h"
#include "index/cells/stretch_ranks.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace isochron::index {

/// Builds the bytes of CellUnit and DeltaUnit (cell_unit.h): the same bytes for the same ranks.
/// Keeps its work space: one for each thread.
class CellUnitBuilder {
  public:
    /// @param first number of the epoch's first step in `ranks`; the last step of `ranks` is the
    ///   epoch's last step
    /// @param lossless whether the level map is lossless
    void build_cells(const StretchRanks& ranks, std::uint32_t first, bool lossless,
                     std::vector<std::byte>& out);
    /// The level map must be lossless.
    /// @param first the epoch's first step in `ranks`: 1 if they begin with the step before, else 0
    void build_deltas(const StretchRanks& ranks, std::uint32_t first, std::vector<std::byte>& out);

  private:
    struct Cells;

    CellTableBuilder table_;
    std::vector<std::array<CellBits, 2>> bits_;
};

} // namespace isochron::index
