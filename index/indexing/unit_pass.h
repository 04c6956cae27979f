// The pass of a build that makes the cells and deltas of every stretch.
#pragma once

#include "index/cells/cell_tier.h"
#include "index/file/sections/file_layout.h"
#include "index/progress.h"
#include "index/system/byte_sink.h"
#include "index/system/mapped_file.h"
#include "index/system/team.h"
#include "index/volume/level_map.h"
#include "index/volume/step_values.h"

#include <vector>

namespace isochron::index {

/// The offsets, sizes and checksums of the units that were written.
struct UnitFindings {
    std::vector<UnitEntry> directory;     ///< epochs, stretches faster
    std::vector<std::uint64_t> checksums; ///< checksums of cells and deltas of every unit
};

/// Builds each member's share of the units, one unit on each thread at a time, and writes them to
/// the file one after the other, in order.
/// @param values the steps of the epochs from `first_epoch` on and, for deltas, the step before
/// @param volume the file that holds the values; parts that have been read are let go
/// @param end of the file so far; moves to the end of the units
/// @param spill name of a member's own temporary file
UnitFindings write_units(const StepValues& values, std::uint32_t first_epoch,
                         const MappedFile& volume, const LevelMap& levels, bool deltas,
                         ByteSink& file, std::uint64_t& end, const std::filesystem::path& spill,
                         unsigned threads, Team& team, const Progress& progress);

} // namespace isochron::index
