// The pass of a build over its arrays: reads every step once, analyzes and packs it.
#pragma once

#include "index/file/sections/file_layout.h"
#include "index/file/sections/value_counts.h"
#include "index/indexing/color_pass.h"
#include "index/indexing/step_writer.h"
#include "index/progress.h"
#include "index/system/byte_sink.h"
#include "index/system/team.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace isochron::index {

/// Where a pass writes.
struct PassTarget {
    ByteSink& file;
    std::uint64_t& end;           ///< end of the file so far; moves to the end of what was written
    std::filesystem::path beside; ///< for temporary files without a name: see ScratchFile
    unsigned threads = 1;
};

/// What a pass does with one of the arrays that it reads.
struct ArrayPass {
    VolumeSeries& series;
    ByteSink* kept; ///< gets the values, for the tree, step after step; null: they are not kept
    ChunkContents contents;
    WriterMeans means;
    ColorPass* colors; ///< gets each new step right after this array; null if there is none
    std::vector<std::uint32_t> since = {}; ///< history of the held chunks: see StepWriter::since
};

/// The results of the pass for an array, the same for every member of the team.
struct VolumeFindings {
    ValueCounts counts;
    std::vector<std::uint64_t> checksums; ///< checksum of every step
    std::vector<std::uint64_t> states;    ///< state of every step's source: VolumeSeries::state
    std::vector<StepEntry> steps;         ///< level after level
    std::uint64_t stayed = 0;             ///< chunk-steps that are as in the step before
    std::optional<ColorFindings> colors;
};

/// Reads each member's share of the steps, a layer of chunks ahead of the work: of every step from
/// `fresh` on all arrays, one right after the other, so that a file with several arrays is read
/// from disk once. Their parts lie in the index in the same order. Each step of the kept values is
/// padded to `step_stride`.
std::vector<VolumeFindings> read_volumes(std::span<const ArrayPass> arrays, std::size_t fresh,
                                         const PassTarget& target, Team& team,
                                         const Progress& progress);

} // namespace isochron::index
