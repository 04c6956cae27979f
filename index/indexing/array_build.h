// Builds one array of an index: packs its values while they are read, then builds its tiers.
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

/// Every member of a team makes an ArrayBuild with equal arguments, which outlive it, and calls the
/// same functions: `pass`, then `take`, then `write_tiers`. All throw as `build_index`.
class ArrayBuild {
  public:
    /// @param options of this array @param number of this array in the index
    /// @param held the array to append to; null for a new one
    ArrayBuild(VolumeSeries& series, const std::filesystem::path& out, const BuildOptions& options,
               std::size_t number, Team& team, BuildTarget& target, const IndexFile* held);
    ~ArrayBuild();

    /// Estimates; better ones once values have been taken.
    ArrayWork work() const;
    /// What the pass over the sources has to do with this array. Valid as long as this.
    ArrayPass pass();
    /// @return false if it cannot be appended to: its cells' levels lack values of the new steps
    bool take(VolumeFindings found);
    /// @return the end of the file with these tiers, a multiple of 64
    std::uint64_t write_tiers(std::uint64_t end, const Progress& progress);
    /// What the sections have to hold. Call it once, on rank 0.
    ArraySections take_sections();

  private:
    class Work;
    std::unique_ptr<Work> work_;
};

} // namespace isochron::index
