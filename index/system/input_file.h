// Opens regular files for reading; all input files are opened here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <ext/stdio_filebuf.h>
#include <filesystem>
#include <istream>
#include <memory>
#include <span>
#include <string>
#include <utility>

namespace isochron::index {

/// Identity, size and time of a file, which show whether it was replaced or written to.
struct FileState {
    std::uint64_t device = 0, inode = 0, size = 0; ///< size in bytes
    std::int64_t written = 0;                      ///< [ns] since 1970
    bool operator==(const FileState&) const = default;
};

/// @throws Error naming the file: missing, a folder, not a regular file
FileState state_of(const std::filesystem::path& path);

/// Opens a file. @return a descriptor, which the caller closes. Pipes, devices and sockets are
/// refused without waiting for them. @throws Error naming the file: missing, a folder, not a
/// regular file, unreadable
int open_regular(const std::filesystem::path& path);

/// A file read by position. Thread-safe.
class InputFile {
  public:
    /// @throws Error as `open_regular`
    explicit InputFile(std::filesystem::path path);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    std::uint64_t size() const { return size_; } ///< [bytes] when it was opened
    int descriptor() const { return file_; }

    /// Reads from `offset` until `out` is full or the file ends. @return bytes read
    /// @throws Error naming the file when the system cannot read it
    std::size_t read(std::uint64_t offset, std::span<std::byte> out) const;

    /// Opens the file once more: advice to the kernel on how one of the two is read does not hold
    /// for the other. Null if the system refuses.
    std::unique_ptr<InputFile> opened_again() const;

  private:
    InputFile(std::filesystem::path path, int file, std::uint64_t size)
        : path_(std::move(path)), file_(file), size_(size) {}

    std::filesystem::path path_;
    int file_ = -1;
    std::uint64_t size_ = 0;
};

/// A file read from its start to its end.
class InputStream : public std::istream {
  public:
    /// @throws Error as `open_regular`
    explicit InputStream(const std::filesystem::path& path);

  private:
    __gnu_cxx::stdio_filebuf<char> buffer_;
};

/// Reads a whole file that should be small.
/// @throws Error as `open_regular`, and when it is larger than `most` bytes
std::string read_text(const std::filesystem::path& path, std::uint64_t most);

} // namespace isochron::index
