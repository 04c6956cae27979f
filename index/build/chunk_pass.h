// The pass of a build that packs the steps into chunks.
#pragma once

#include "index/build/step_writer.h"
#include "index/file/file_layout.h"
#include "index/progress.h"
#include "index/system/mapped_file.h"
#include "index/system/team.h"
#include "index/volume/step_values.h"

#include <vector>

namespace isochron::index {

/// Packs each member's share of the steps from `first` on, one after the other with all threads,
/// and writes them behind each other, with their levels of detail.
/// @param info of the series @param volume where the values lie; what has been read of it is let go
/// @param end of the file so far; moves behind what was written
/// @param spill name for files of members that have to wait for others
/// @return where the steps are, level after level
std::vector<StepEntry> write_chunks(const SeriesInfo& info, const StepValues& values,
                                    std::size_t first, const MappedFile& volume,
                                    const ChunkContents& contents, ByteSink& file,
                                    std::uint64_t& end, const std::filesystem::path& spill,
                                    unsigned threads, Team& team, const Progress& progress);

/// The steps of all members, once they are where they belong, level after level.
/// @param mine step after step
std::vector<StepEntry> placed_steps(PartWriter& parts, std::vector<StepEntry> mine,
                                    std::size_t levels, std::uint64_t& end, Team& team);

} // namespace isochron::index
