// A file mapped read-only into memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace isochron::index {

/// The whole of a regular file as it was when it was mapped. Pages are read when they are first
/// touched. Limit: when the file is made shorter meanwhile, or its disk fails, touching it ends the
/// program with SIGBUS.
class MappedFile {
  public:
    /// @throws Error: missing, unreadable, not a regular file, too large to map
    explicit MappedFile(const std::filesystem::path& path);
    ~MappedFile();
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;

    std::span<const std::byte> bytes() const { return bytes_; }

    /// Says that a part has been read: its pages no longer count as memory of this process. It may
    /// be read again, also meanwhile.
    void let_go(std::span<const std::byte> part) const;

  private:
    std::span<const std::byte> bytes_;
};

} // namespace isochron::index
