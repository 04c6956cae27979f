// Reads bytes of a file by position, after decompression.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace isochron::index {

/// `hex`: two digits for each byte, blanks and line ends between them do not count.
enum class Compression : std::uint8_t { none, deflate, bzip2, hex };

/// Size of a regular, readable file. @throws Error: missing, a folder, unreadable
std::uint64_t file_bytes(const std::filesystem::path& path);

/// The first bytes of a file, up to `most`; a gzip-compressed file is decompressed.
std::string head_of(const std::filesystem::path& path, std::size_t most);
/// Whether the file starts like a gzip file.
bool is_gzip(const std::filesystem::path& path);

/// Checks that `path` can hold `bytes` of data after `offset`, so that a false header does not cost
/// memory. @throws Error naming the file when it cannot, even with the best compression
void expect_room(const std::filesystem::path& path, std::uint64_t offset, Compression compression,
                 std::uint64_t bytes);

/// The bytes that follow a place in the data.
struct Rest {
    static constexpr std::uint64_t kMostCounted = std::uint64_t{1} << 30;

    std::uint64_t bytes = 0;   ///< decompressed; counted up to `kMostCounted`
    std::uint64_t foreign = 0; ///< bytes of the file after the end of the compressed data
};

/// Reading forward decompresses each byte once; going back starts from the beginning again.
class DataStream {
  public:
    virtual ~DataStream() = default;

    /// Reads `out.size()` bytes from `position` in the decompressed data.
    /// @throws Error naming the file: the data end too early, or are damaged
    virtual void read(std::uint64_t position, std::span<std::byte> out) = 0;

    /// Reads from `position` to the end, where compressed data have their checksum.
    /// @throws Error naming the file: the data are truncated, or do not match their checksum
    virtual Rest rest(std::uint64_t position) = 0;
};

/// @param offset of the first byte of (compressed) data in the file; `deflate` reads zlib and gzip
std::unique_ptr<DataStream> open_data(const std::filesystem::path& path, std::uint64_t offset,
                                      Compression compression);

} // namespace isochron::index
