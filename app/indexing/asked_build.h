// Builds the index that arguments ask for, or appends to it.
#pragma once

#include "app/indexing/build_arguments.h"
#include "app/indexing/build_sources.h"
#include "index/progress.h"
#include "index/system/growing_file.h"
#include "index/system/team.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// Each member of a team constructs one, takes the same sources, and writes: together they make one index.
class AskedBuild {
  public:
    /// Opens the index that is to grow, if one is. @throws index::Error: there is none, or damaged
    AskedBuild(const BuildArguments& asked, index::Team& team);

    /// The arguments; what they leave open is as the index that grows has it.
    const BuildArguments& arguments() const { return arguments_; }
    /// @param files that an index may refer to
    /// @return false: the index holds every step already @throws index::Error, UsageError
    bool take(BuildSources sources, const std::vector<std::filesystem::path>& files);
    /// After `take`: one sentence if the steps of the index had to be read again and compared, because this
    /// program understands the files in another way than the one that made the index; else empty.
    std::string reread() const;
    double bytes() const; ///< bytes of the values that are to be read
    /// Appends in place where that can be, else builds anew.
    /// @return why an index that should grow was written anew; empty: it grew, or is new
    /// @throws index::Error
    std::string write(const index::Progress& progress);
    /// The index: after `write` as it was written, before as it was found. On rank 0.
    const index::IndexFile& index() const { return *held_; }

  private:
    BuildArguments arguments_;
    index::Team& team_;
    std::optional<index::GrowingFile> file_;       ///< the index that grows
    std::shared_ptr<const index::IndexFile> held_; ///< null: it is built anew, and not written yet
    BuildSources sources_;
    index::BuildOptions options_;
};

} // namespace isochron::app
