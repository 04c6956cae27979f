// Bytes of a file as they are after decompression, read by position.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace isochron::index {

enum class Compression : std::uint8_t { none, deflate, bzip2 };

/// Size of a regular, readable file. @throws Error: missing, a folder, unreadable
std::uint64_t file_bytes(const std::filesystem::path& path);

/// The first bytes of a file, up to `most`; gzip-compressed ones are decompressed.
std::string head_of(const std::filesystem::path& path, std::size_t most);

/// True when the file starts as a gzip file does.
bool is_gzip(const std::filesystem::path& path);

/// @throws Error naming the file when `bytes` of data cannot be in `path` after `offset`, given how
///         well its compression can do at best: a header that lies must not cost memory
void expect_room(const std::filesystem::path& path, std::uint64_t offset, Compression compression,
                 std::uint64_t bytes);

/// What follows a place in the data.
struct Rest {
    static constexpr std::uint64_t kMostCounted = std::uint64_t{1} << 30;

    std::uint64_t bytes = 0;   ///< decompressed; counted no further than `kMostCounted`
    std::uint64_t foreign = 0; ///< of the file, behind the end of what is compressed
};

/// Reading forward decompresses each byte once; going back starts again from the beginning.
class DataStream {
  public:
    virtual ~DataStream() = default;

    /// Reads `out.size()` bytes from `position` in the decompressed data.
    /// @throws Error naming the file: the data end before that, or are damaged
    virtual void read(std::uint64_t position, std::span<std::byte> out) = 0;

    /// Reads on from `position` to the end, where compressed data have their check.
    /// @throws Error naming the file: the data are truncated, or differ from their check
    virtual Rest rest(std::uint64_t position) = 0;
};

/// @param offset of the first byte of (compressed) data in the file; `deflate` takes zlib and gzip
std::unique_ptr<DataStream> open_data(const std::filesystem::path& path, std::uint64_t offset,
                                      Compression compression);

} // namespace isochron::index
