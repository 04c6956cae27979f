// The pass of a build that makes the cells and deltas of every chunk.
#pragma once

#include "index/cells/cell_tier.h"
#include "index/file/file_layout.h"
#include "index/progress.h"
#include "index/system/mapped_file.h"
#include "index/system/new_file.h"
#include "index/system/team.h"
#include "index/volume/level_map.h"
#include "index/volume/step_values.h"

#include <vector>

namespace isochron::index {

/// The units section as it was written.
struct UnitFindings {
    std::uint64_t bytes = 0;
    std::uint64_t entries = 0;            ///< of the cells
    std::vector<UnitEntry> directory;     ///< epochs, chunks faster
    std::vector<std::uint64_t> checksums; ///< of cells and deltas of every unit
};

/// Builds each member's share of the units, as many at a time as there are threads, and writes them
/// to the file one behind the other, in their order.
/// @param volume where the values lie; what has been read of it is let go
/// @param spill name for a member's own temporary file
UnitFindings write_units(const StepValues& values, const MappedFile& volume, const LevelMap& levels,
                         bool deltas, NewFile& file, std::uint64_t offset,
                         const std::filesystem::path& spill, unsigned threads, Team& team,
                         const Progress& progress);

} // namespace isochron::index
