// The pass of a build that reads the array to color by.
#pragma once

#include "index/build/chunk_pass.h"
#include "index/file/index_contents.h"
#include "index/progress.h"
#include "index/system/new_file.h"
#include "index/system/team.h"

namespace isochron::index {

/// @throws Error naming the array when its grid or its steps are not the volume's
void expect_colors_of(const SeriesInfo& colors, const SeriesInfo& volume);

/// What the pass has found, the same for every member.
struct ColorFindings {
    ColorArray array; ///< `chosen_*` are left empty
    ChunkFindings chunks;
    std::vector<std::uint64_t> checksums; ///< of the stored values of every step
};

/// Reads each member's share of the steps and packs their values where `contents` says so.
ColorFindings read_colors(VolumeSeries& series, const ChunkContents& contents, NewFile& file,
                          std::uint64_t offset, const std::filesystem::path& spill,
                          unsigned threads, Team& team, const Progress& progress);

} // namespace isochron::index
