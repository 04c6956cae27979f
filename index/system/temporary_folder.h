// A folder in which files of this process alone lie until they have their names.
#pragma once

#include "index/system/descriptor.h"

#include <filesystem>

namespace isochron::index {

/// Lies beside the file that it is for. Nobody else can look into it or lay links there. Destroyed
/// with all that is left in it; of a process that was killed, `remove_remains_in` removes it.
class TemporaryFolder {
  public:
    /// @throws Error naming the file when the folder cannot be made
    explicit TemporaryFolder(const std::filesystem::path& beside);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    Descriptor lock_; ///< shows others that its process is alive
};

} // namespace isochron::index
