// The first pass of a build: every step is read once, kept and looked at.
#pragma once

#include "index/file/index_file.h"
#include "index/progress.h"
#include "index/system/byte_sink.h"
#include "index/system/team.h"

#include <vector>

namespace isochron::index {

/// What is known once all steps have been read, the same for every member of the team.
struct VolumeFindings {
    ValueCounts counts;
    std::vector<std::uint64_t> checksums; ///< of every step, without its padding
    std::vector<std::uint64_t> states;    ///< of every step's source, VolumeSeries::state
    LevelMap levels;
};

/// Reads each member's share of the steps from `first` on, small ones one ahead of what is worked
/// on, and writes them to the file, step after step, each padded to `step_stride`. Looks at those
/// from `fresh` on alone.
VolumeFindings read_volume(VolumeSeries& series, std::size_t first, std::size_t fresh,
                           ByteSink& file, Team& team, const Progress& progress);

} // namespace isochron::index
