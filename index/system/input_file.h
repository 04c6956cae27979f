// Opens regular files for reading; all input files are opened here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <memory>
#include <mutex>
#include <span>
#include <streambuf>
#include <string>
#include <utility>
#include <vector>

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

/// What a file said of itself when it was seen first.
struct FileHead {
    FileState state;
    std::string bytes; ///< its first ones, as many as FilesSeen keeps
};

/// While one lives, whoever looks at the beginning of a file on this thread finds it as it was first
/// seen, without opening it again: many files are each looked at by several parts of the program.
/// Bytes behind it are read from the file, which must not have changed since. Of several at the same
/// time the first one keeps all.
class FilesSeen {
  public:
    FilesSeen();
    ~FilesSeen();
    FilesSeen(const FilesSeen&) = delete;
    FilesSeen& operator=(const FilesSeen&) = delete;
    static constexpr std::size_t kHead = 4096; ///< bytes that formats look at first

  private:
    bool keeps_;
};

/// A file read by position. Thread-safe.
class InputFile {
  public:
    /// @throws Error as `open_regular`
    explicit InputFile(std::filesystem::path path);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    std::uint64_t size() const { return size_; } ///< [bytes] when it was opened
    /// @throws Error: it has changed since it was seen (FilesSeen)
    int descriptor() const;

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
    std::shared_ptr<const FileHead> seen_; ///< null: it has been opened
    mutable std::once_flag opened_;        ///< once more than was seen is needed
    mutable int file_ = -1;
    std::uint64_t size_ = 0;
};

/// A file read from its start to its end.
class InputStream : public std::istream {
  public:
    /// @throws Error as `open_regular`
    explicit InputStream(const std::filesystem::path& path);

  private:
    class Buffer : public std::streambuf {
      public:
        explicit Buffer(const std::filesystem::path& path) : file_(path) {}

      protected:
        int_type underflow() override;

      private:
        InputFile file_;
        std::uint64_t next_ = 0;
        std::vector<char> block_;
    };
    Buffer buffer_;
};

/// Reads a whole file that should be small.
/// @throws Error as `open_regular`, and when it is larger than `most` bytes
std::string read_text(const std::filesystem::path& path, std::uint64_t most);

} // namespace isochron::index
