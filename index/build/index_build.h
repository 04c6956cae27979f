// Building of .isochron files.
#pragma once

#include "index/file/chunk_codec.h"
#include "index/file/index_file.h"
#include "index/progress.h"
#include "index/system/byte_sink.h"
#include "index/system/team.h"

namespace isochron::index {

struct BuildOptions {
    std::optional<TierSet> tiers =
        {}; ///< instead of the planner's choice, which leaves out the tree
    /// Instead of a choice: that of an index which is written anew, where it still can be.
    std::optional<TierPlan> plan = {};
    bool with_tree = false; ///< besides
    ThiOptions tree = {};
    unsigned threads = 0; ///< 0 for as many as there are processors
    /// Of planes of a level of detail, and of steps whose values have more than 8 bits, that wait in
    /// memory to be packed; more wait in a file.
    std::uint64_t waiting_bytes = 64 << 20;
    Codec codec = Codec::fitting;
    /// When set the file refers to these instead of carrying a copy of the values.
    std::optional<Referral> referral = {};
    /// Carried to color surfaces by: another array of the same files. Outlives the build.
    VolumeSeries* color = nullptr;
    /// What picks it in the files, for an index that refers to them.
    std::optional<std::string> color_array = {}, color_component = {};
    /// What picks the volume itself.
    std::optional<std::string> array = {}, component = {};
};

/// Reads a series once and writes NAME.isochron under a temporary name, then renames it.
/// Progress is that of the whole build, whatever the phase. On any failure, also a canceled one, nothing is left behind. An existing index is replaced;
/// any other existing file is refused. The same series and options give the same bytes, whatever
/// the number of threads and of processes. Memory of each process: a few layers of 16 planes, where
/// the format can be read piece by piece, and a little more than twice `waiting_bytes`; where cells
/// are built some 150 MiB for each thread; the paper's tree, where asked for, takes 30 bytes for
/// each cell-step more.
/// @param team all of whose members call this with the same series and options
/// @throws Error: as the series reads, unwritable, disk full, larger than `CellId` can count
void build_index(VolumeSeries& series, const std::filesystem::path& out,
                 const BuildOptions& options, const Progress& progress = {});
void build_index(VolumeSeries& series, const std::filesystem::path& out,
                 const BuildOptions& options, const Progress& progress, Team& team);

/// Appends the steps that an index does not hold yet, in place: it writes behind the end of the
/// file and where no header that counts names anything, and last the header. Killed at any moment it leaves the old index or the new one; whoever
/// has the old one open goes on with it. What queries answer and the content hash are those of an
/// index built anew. Cells come by whole epochs: where fewer steps are new than old in an epoch,
/// they wait until it is complete, and bricks are searched meanwhile.
/// @param series all steps; of those that are held it is asked for values that cells need
/// @param held the newest state of the file @param file opened for writing, for the first member
///        alone @param options tiers, codec, referral and colors as the index has them
/// @return false, and nothing is written, where that cannot be: its cells are of a type of more
///         than 8 bits and miss values of the new steps
/// @throws Error as `build_index`; the index stays as it was
bool append_index(VolumeSeries& series, const IndexFile& held, GrowingSink& file,
                  const std::filesystem::path& out, const BuildOptions& options,
                  const Progress& progress, Team& team);

} // namespace isochron::index
