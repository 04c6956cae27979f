// A file that appears under its name only when it is complete.
#pragma once

#include "index/system/byte_sink.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace isochron::index {

/// Writes all bytes to an open file. @return 0, or the system's error number
int write_all(int file, std::uint64_t offset, std::span<const std::byte> bytes);

/// Makes a folder, and its parents, if they are missing.
/// @throws Error naming it, with the system's message
void make_folder(const std::filesystem::path& folder);

/// The name at the end of symbolic links, whether or not there is a file: what is written under
/// `path` belongs there, and the links stay.
/// @throws Error when they lead in a circle
std::filesystem::path end_of_links(std::filesystem::path path);

/// As ByteSink::begin_flush, for an open file.
void begin_flush_of(int file);

/// Writes to `.NAME.XXXX.tmp` in the folder of NAME, which is the end of the links that the target
/// leads through; `commit` renames it. If it is destroyed before
/// that, it removes the temporary file, and an older file of that name stays as it was. Every
/// function throws Error with the final name and the system's message (disk full, folder not
/// writable, ...).
class NewFile final : public ByteSink {
  public:
    /// @throws Error also when `target` exists and is not a regular file
    explicit NewFile(std::filesystem::path target);
    /// Writes to the temporary file of another process, which owns it: `commit` only flushes then.
    NewFile(std::filesystem::path target, std::filesystem::path temporary);
    ~NewFile() override;
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;

    /// Claims disk space from the start of the file, so that a full disk is found before the work.
    void reserve(std::uint64_t bytes);
    void write_at(std::uint64_t offset, std::span<const std::byte> bytes) override;
    void begin_flush() override;
    /// Removes temporary files that killed writers of the same NAME have left.
    void remove_remains() const;
    /// Flushes to disk, then renames the file to its final name.
    void commit();

    const std::filesystem::path& temporary() const { return temporary_; }

  private:
    [[noreturn]] void fail(int error) const;
    std::filesystem::path target_, temporary_;
    int file_ = -1;
    bool owner_ = true;
};

} // namespace isochron::index
