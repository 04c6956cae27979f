// Builds .isochron files, and appends steps to them.
#pragma once

#include "index/file/index_file.h"
#include "index/indexing/build_options.h"
#include "index/progress.h"
#include "index/system/byte_sink.h"
#include "index/system/team.h"

#include <filesystem>
#include <memory>

namespace isochron::index {

/// Reads a series once and writes NAME.isochron under a temporary name, then renames it. Reported
/// fractions are of the whole build, not of the phase. A build that fails or is canceled leaves
/// nothing behind. An existing index is replaced; any other existing file is refused. The same
/// series and options give the same bytes for any number of threads and processes. Memory of each
/// process: a few layers of 16 planes, if the format can be read piece by piece, and a little more
/// than twice `waiting_bytes`. Building the paper's tree takes 30 bytes more for each cell and step.
/// @param team all its members call this with the same series and options
/// @return the new index on rank 0, null on others; it was opened before it got its name
/// @throws Error: as reading the series, unwritable, disk full, larger than `CellId` can count
std::shared_ptr<const IndexFile> build_index(VolumeSeries& series, const std::filesystem::path& out,
                                             const BuildOptions& options,
                                             const Progress& progress = {});
std::shared_ptr<const IndexFile> build_index(VolumeSeries& series, const std::filesystem::path& out,
                                             const BuildOptions& options, const Progress& progress,
                                             Team& team);

/// Appends, in place, the steps that an index does not hold yet. It writes after the end of the
/// file and where the present header names nothing, and writes the header last. If it is killed at
/// any moment, the old index or the new one is left; programs that have the old one open can go on
/// with it. Queries and the content hash are the same as of an index built anew. Tiers of earlier
/// programs that no search uses are not named in the new state.
/// @param series all steps; of those that the index holds, at most the last is read
/// @param held the newest state of the file, with as many arrays as are given
/// @param file opened for writing, with `alone` on rank 0 only
/// @param options tiers, codec, referral and colors as the index has them
/// @return the index with its new steps on rank 0, null on others
/// @throws Error as `build_index`; the index stays as it was, but where it has grown and cannot be
/// opened
std::shared_ptr<const IndexFile> append_index(VolumeSeries& series, const IndexFile& held,
                                              GrowingSink& file, const std::filesystem::path& out,
                                              const BuildOptions& options, const Progress& progress,
                                              Team& team);

} // namespace isochron::index
