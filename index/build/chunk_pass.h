// The pass of a build that packs the steps into chunks.
#pragma once

#include "index/build/part_writer.h"
#include "index/file/chunk_codec.h"
#include "index/file/file_layout.h"
#include "index/progress.h"
#include "index/system/mapped_file.h"
#include "index/system/team.h"
#include "index/volume/level_map.h"
#include "index/volume/step_values.h"

#include <vector>

namespace isochron::index {

/// What goes into the chunks of the volume.
struct ChunkContents {
    bool bricks = true, values = true;
    Codec codec = Codec::fitting;
};

/// Steps of one array in the volume section.
struct ChunkFindings {
    std::uint64_t bytes = 0;
    std::vector<StepEntry> steps;
};

/// Packs each member's share of the steps, one after the other with all threads, and writes them
/// behind each other.
/// @param volume where the values lie; what has been read of it is let go
/// @param spill name for files of members that have to wait for others
ChunkFindings write_chunks(const StepValues& values, const MappedFile& volume,
                           const LevelMap& levels, const ChunkContents& contents, NewFile& file,
                           std::uint64_t offset, const std::filesystem::path& spill,
                           unsigned threads, Team& team, const Progress& progress);

/// The steps of all members, once they are where they belong.
ChunkFindings placed_steps(PartWriter& parts, std::vector<StepEntry> mine, Team& team);

} // namespace isochron::index
