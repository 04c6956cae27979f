// A file mapped read-only into memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace isochron::index {

/// A whole regular file. Pages are read when they are first touched. Limit: if the file becomes
/// shorter meanwhile or its disk fails, touching the memory ends the program with SIGBUS.
class MappedFile {
  public:
    /// @throws Error: missing, unreadable, not a regular file, too large to map
    explicit MappedFile(const std::filesystem::path& path);
    ~MappedFile();
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;

    std::span<const std::byte> bytes() const { return bytes_; }

  private:
    std::span<const std::byte> bytes_;
};

} // namespace isochron::index
