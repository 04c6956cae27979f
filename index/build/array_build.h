// Builds one array of an index: reads its series once, and writes all its parts but the sections.
#pragma once

#include "index/build/build_options.h"
#include "index/build/build_target.h"
#include "index/build/section_writer.h"
#include "index/progress.h"
#include "index/system/team.h"

#include <cstdint>
#include <filesystem>
#include <memory>

namespace isochron::index {

/// All members of a team make one with the same arguments, which outlive it, and call the same
/// functions.
class ArrayBuild {
  public:
    /// @param options of this array @param held the array to append to; null for a new one
    /// @param end of the file so far
    ArrayBuild(VolumeSeries& series, const std::filesystem::path& out, const BuildOptions& options,
               const Progress& progress, Team& team, BuildTarget& target, const IndexFile* held,
               std::uint64_t end);
    ~ArrayBuild();

    /// @return false if appending would give cells whose levels lack values @throws Error as
    ///         `build_index`
    bool write_parts();
    /// The end of the file with these parts, a multiple of 64.
    std::uint64_t end() const;
    /// What the sections have to hold. Call it once, on rank 0.
    ArraySections take_sections();
    /// Reports that all is written, but not flushed to disk.
    void report_flushing() const;

  private:
    class Work;
    std::unique_ptr<Work> work_;
};

} // namespace isochron::index
