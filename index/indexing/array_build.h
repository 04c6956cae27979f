// Builds one array of an index: what to do with its values when they are read, then the tree.
#pragma once

#include "index/indexing/build_options.h"
#include "index/indexing/build_target.h"
#include "index/indexing/section_writer.h"
#include "index/indexing/volume_pass.h"
#include "index/progress.h"
#include "index/system/team.h"

#include <cstdint>
#include <filesystem>
#include <memory>

namespace isochron::index {

/// The work of building an array, in bytes to read.
struct ArrayWork {
    double reading = 0, indexing = 0;
};

/// All members of a team make one with the same arguments, which outlive it, and call the same
/// functions: `pass`, then `take`, then `write_tree`. All throw as `build_index`.
class ArrayBuild {
  public:
    /// @param options of this array @param number of this array in the index
    /// @param held the array to append to; null for a new one
    ArrayBuild(VolumeSeries& series, const std::filesystem::path& out, const BuildOptions& options,
               std::size_t number, Team& team, BuildTarget& target, const IndexFile* held);
    ~ArrayBuild();

    /// Estimates.
    ArrayWork work() const;
    /// What the pass over the sources has to do with this array. Valid as long as this.
    ArrayPass pass();
    void take(VolumeFindings found);
    /// Writes the paper's tree, if the index is to have one.
    /// @return the end of the file then, a multiple of 64
    std::uint64_t write_tree(std::uint64_t end, const Progress& progress);
    /// What the sections have to hold. Call it once, on rank 0.
    ArraySections take_sections();

  private:
    class Work;
    std::unique_ptr<Work> work_;
};

} // namespace isochron::index
