// The pass of a build over the series: reads every step once, analyzes and packs it.
#pragma once

#include "index/build/color_pass.h"
#include "index/build/step_writer.h"
#include "index/file/file_layout.h"
#include "index/file/value_counts.h"
#include "index/progress.h"
#include "index/system/byte_sink.h"
#include "index/system/team.h"
#include "index/volume/level_map.h"

#include <optional>
#include <vector>

namespace isochron::index {

/// The output of a pass.
struct PassTarget {
    ByteSink& file;
    std::uint64_t& end; ///< of the file so far; moves to the end of what was written
    ChunkContents contents;
    WriterMeans means; ///< `beside` also takes the parts of team members that must wait for others
};

/// Keeps the values from which cells or the tree are built.
struct KeptValues {
    ByteSink* file = nullptr; ///< null: nothing is kept
    /// Keep values even if levels turn out not to be lossless.
    bool always = true;
};

/// The results of the pass, the same for every member of the team.
struct VolumeFindings {
    ValueCounts counts;
    std::vector<std::uint64_t> checksums; ///< of every step
    std::vector<std::uint64_t> states;    ///< of every step's source: VolumeSeries::state
    LevelMap levels;
    std::vector<StepEntry> steps; ///< level after level
    std::optional<ColorFindings> colors;
};

/// Reads each member's share of the steps from `first` on, a layer of chunks ahead of the work.
/// Keeps the values of all of them, step after step, each padded to `step_stride`; analyzes and
/// packs only the steps from `fresh` on.
/// @param colors gets each of those steps right after the volume's; null if there is none
VolumeFindings read_volume(VolumeSeries& series, std::size_t first, std::size_t fresh,
                           const KeptValues& kept, const PassTarget& target, ColorPass* colors,
                           Team& team, const Progress& progress);

} // namespace isochron::index
