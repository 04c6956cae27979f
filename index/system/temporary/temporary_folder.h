// A folder in which files of this process alone lie until they have their names.
#pragma once

#include "index/system/descriptor.h"
#include "index/system/temporary/remains.h"

#include <filesystem>
#include <string>
#include <system_error>

namespace isochron::index {

/// Lies beside the file that it is for. Nobody else can look into it or lay links there. Destroyed
/// with the files that are left in it; of a process that was killed, `remove_remains_in` removes it.
class TemporaryFolder {
  public:
    /// @param contents how the names of all files begin that are made in it
    /// @throws Error naming the file when the folder cannot be made
    TemporaryFolder(const std::filesystem::path& beside, std::string contents);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    /// Gives the folder itself this name, with all that is in it and the rights of any new folder,
    /// where nothing is, or an empty folder: all or nothing.
    std::error_code take_name(const std::filesystem::path& name);

  private:
    std::filesystem::path path_;
    std::string contents_;
    Descriptor lock_; ///< shows others that its process is alive
    LedgerEntry entry_;
};

} // namespace isochron::index
