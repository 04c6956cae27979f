// The pass of a build over the series: every step is read once, looked at, and packed.
#pragma once

#include "index/build/step_writer.h"
#include "index/file/file_layout.h"
#include "index/file/value_counts.h"
#include "index/progress.h"
#include "index/system/byte_sink.h"
#include "index/system/team.h"
#include "index/volume/level_map.h"

#include <filesystem>
#include <vector>

namespace isochron::index {

/// Where what is read goes to.
struct PassTarget {
    ByteSink& file;
    std::uint64_t& end; ///< of the file so far; moves behind what was written
    ChunkContents contents;
    WriterMeans means; ///< files of members that have to wait for others are there, too
};

/// Where values are kept that cells or the tree are built of.
struct KeptValues {
    ByteSink* file = nullptr; ///< nothing is kept where there is none
    /// Also where levels turn out not to be lossless.
    bool always = true;
};

/// What is known once all steps have been read, the same for every member of the team.
struct VolumeFindings {
    ValueCounts counts;
    std::vector<std::uint64_t> checksums; ///< of every step
    std::vector<std::uint64_t> states;    ///< of every step's source, VolumeSeries::state
    LevelMap levels;
    std::vector<StepEntry> steps; ///< level after level
};

/// Reads each member's share of the steps from `first` on, a layer of chunks ahead of what is
/// worked on. Keeps them all, step after step, each padded to `step_stride`; looks at those from
/// `fresh` on alone, and packs these.
VolumeFindings read_volume(VolumeSeries& series, std::size_t first, std::size_t fresh,
                           const KeptValues& kept, const PassTarget& target, Team& team,
                           const Progress& progress);

/// The steps of all members, once they are where they belong, level after level.
/// @param mine step after step @param end of the file so far; moves behind them
std::vector<StepEntry> placed_steps(PartWriter& parts, std::vector<StepEntry> mine,
                                    std::size_t levels, std::uint64_t& end, Team& team);

} // namespace isochron::index
