// One step in several files, each with a block of its grid: the parts of a ParaView collection.
#pragma once

#include "index/readers/formats/series/file_series.h"

#include <memory>
#include <vector>

namespace isochron::index {

/// Blocks of one regular grid, which may share planes of vertices; in these the last file counts.
/// @param parts how each file is opened; each has one step
/// @throws Error naming a file: blocks that differ in spacing, array and so on, that do not lie on
///         one grid, or leave vertices without values
std::unique_ptr<VolumeFile> join_blocks(std::vector<SeriesFile> parts, const ReadOptions& options);

} // namespace isochron::index
