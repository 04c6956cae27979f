// Builds the units of a series: cells and deltas of one stretch in one epoch.
#pragma once

#include "index/cells/cell_unit_build.h"
#include "index/cells/stretch_ranks.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace isochron::index {

struct UnitBytes {
    std::vector<std::byte> cells, deltas;
    std::uint64_t entries = 0; ///< entries of the cells
};

/// Keeps its work space: one for each thread.
class UnitBuilder {
  public:
    UnitBuilder(const StepValues& values, const LevelMap& levels);

    /// Builds one stretch in one epoch. @param out replaced; its memory is used again
    void build(std::uint32_t stretch, std::uint32_t epoch, bool deltas, UnitBytes& out);

  private:
    std::uint32_t steps_;
    bool lossless_;
    StretchRanks ranks_;
    CellUnitBuilder builder_;
};

} // namespace isochron::index
