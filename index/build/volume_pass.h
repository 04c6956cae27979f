// The first pass of a build: every step is read once, kept and looked at.
#pragma once

#include "index/file/index_file.h"
#include "index/progress.h"
#include "index/system/mapped_file.h"
#include "index/system/new_file.h"
#include "index/system/team.h"

#include <vector>

namespace isochron::index {

/// What is known once all steps have been read, the same for every member of the team.
struct VolumeFindings {
    double low = 0, high = 0; ///< of the finite scaled values; 0 when there are none
    std::uint64_t nan_values = 0;
    std::vector<std::uint64_t> checksums; ///< of every step, without its padding
    LevelMap levels;
};

/// Reads each member's share of the steps, small ones one ahead of what is worked on, and writes
/// them to the file, step after step, each padded to `step_stride`.
VolumeFindings read_volume(VolumeSeries& series, NewFile& file, std::uint64_t offset, Team& team,
                           const Progress& progress);

/// Counts all finite scaled values into kHistogramBins equal bins.
/// @param volume where the values lie; what has been read of it is let go
std::vector<std::uint64_t> count_values(const StepValues& values, const MappedFile& volume,
                                        double low, double high, unsigned threads, Team& team,
                                        const Progress& progress);

} // namespace isochron::index
