// Plain, deflate and bzip2 data behind one interface.
#include "index/formats/data_stream.h"

#include "index/error.h"

#include <bzlib.h>
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kChunk = 1 << 18;

std::ifstream open_file(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in)
        throw Error(fmt::format("{}: cannot be opened: {}", path.string(),
                                std::generic_category().message(errno)));
    return in;
}

class PlainData final : public DataStream {
  public:
    PlainData(fs::path path, std::uint64_t offset)
        : path_(std::move(path)), offset_(offset), in_(open_file(path_)) {}

    void read(std::uint64_t position, std::span<std::byte> out) override {
        in_.clear();
        in_.seekg(static_cast<std::streamoff>(offset_ + position));
        in_.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(out.size()));
        if (!in_)
            throw Error(fmt::format("{}: truncated: data end at byte {}, expected {}",
                                    path_.string(), file_bytes(path_),
                                    offset_ + position + out.size()));
    }

  private:
    fs::path path_;
    std::uint64_t offset_;
    std::ifstream in_;
};

/// zlib's streaming interface; concatenated members are one stream, as gzip has it.
class Deflate {
  public:
    static constexpr const char* kName = "deflate";
    Deflate() {
        constexpr int kZlibOrGzip = 47;
        if (inflateInit2(&stream_, kZlibOrGzip) != Z_OK)
            throw Error("zlib: out of memory");
    }
    ~Deflate() { inflateEnd(&stream_); }
    Deflate(const Deflate&) = delete;
    Deflate& operator=(const Deflate&) = delete;

    /// Consumes from `in`, fills from the front of `out`. @return false when the data are damaged
    bool step(std::span<char>& in, std::span<std::byte>& out) {
        if (ended_) {
            inflateReset(&stream_);
            ended_ = false;
        }
        stream_.next_in = reinterpret_cast<Bytef*>(in.data());
        stream_.avail_in = static_cast<uInt>(in.size());
        stream_.next_out = reinterpret_cast<Bytef*>(out.data());
        stream_.avail_out = static_cast<uInt>(std::min(out.size(), kMost));
        const std::size_t offered = stream_.avail_out;
        const int result = inflate(&stream_, Z_NO_FLUSH);
        in = in.last(stream_.avail_in);
        out = out.subspan(offered - stream_.avail_out);
        ended_ = result == Z_STREAM_END;
        return result == Z_OK || result == Z_STREAM_END || result == Z_BUF_ERROR;
    }

  private:
    static constexpr std::size_t kMost = 1 << 30;
    z_stream stream_{};
    bool ended_ = false;
};

class Bzip2 {
  public:
    static constexpr const char* kName = "bzip2";
    Bzip2() { start(); }
    ~Bzip2() { BZ2_bzDecompressEnd(&stream_); }
    Bzip2(const Bzip2&) = delete;
    Bzip2& operator=(const Bzip2&) = delete;

    bool step(std::span<char>& in, std::span<std::byte>& out) {
        if (ended_) {
            BZ2_bzDecompressEnd(&stream_);
            start();
        }
        stream_.next_in = in.data();
        stream_.avail_in = static_cast<unsigned>(in.size());
        stream_.next_out = reinterpret_cast<char*>(out.data());
        stream_.avail_out = static_cast<unsigned>(std::min(out.size(), kMost));
        const std::size_t offered = stream_.avail_out;
        const int result = BZ2_bzDecompress(&stream_);
        in = in.last(stream_.avail_in);
        out = out.subspan(offered - stream_.avail_out);
        ended_ = result == BZ_STREAM_END;
        return result == BZ_OK || result == BZ_STREAM_END;
    }

  private:
    void start() {
        stream_ = {};
        ended_ = false;
        if (BZ2_bzDecompressInit(&stream_, 0, 0) != BZ_OK)
            throw Error("bzip2: out of memory");
    }

    static constexpr std::size_t kMost = 1 << 30;
    bz_stream stream_{};
    bool ended_ = false;
};

template <class Decoder>
class CompressedData final : public DataStream {
  public:
    CompressedData(fs::path path, std::uint64_t offset)
        : path_(std::move(path)), offset_(offset), chunk_(kChunk) {
        rewind();
    }

    void read(std::uint64_t position, std::span<std::byte> out) override {
        if (position < position_)
            rewind();
        std::vector<std::byte> skipped(std::min<std::uint64_t>(position - position_, kChunk));
        while (position_ < position)
            fill(std::span(skipped).first(
                std::min<std::uint64_t>(position - position_, skipped.size())));
        fill(out);
    }

  private:
    void rewind() {
        in_ = open_file(path_);
        in_.seekg(static_cast<std::streamoff>(offset_));
        decoder_.emplace();
        pending_ = {};
        position_ = 0;
    }

    void fill(std::span<std::byte> out) {
        const std::uint64_t end = position_ + out.size();
        while (!out.empty()) {
            if (pending_.empty()) {
                in_.read(chunk_.data(), static_cast<std::streamsize>(chunk_.size()));
                pending_ = std::span(chunk_).first(static_cast<std::size_t>(in_.gcount()));
            }
            const std::size_t wanted = out.size(), had = pending_.size();
            const bool good = decoder_->step(pending_, out);
            position_ += wanted - out.size();
            if (!good)
                throw Error(fmt::format("{}: damaged {} data after {} decompressed bytes",
                                        path_.string(), Decoder::kName, position_));
            if (had == 0 && wanted == out.size())
                throw Error(
                    fmt::format("{}: truncated: {} data end after {} bytes, expected at least {}",
                                path_.string(), Decoder::kName, position_, end));
        }
    }

    fs::path path_;
    std::uint64_t offset_;
    std::ifstream in_;
    std::vector<char> chunk_;
    std::span<char> pending_;
    std::optional<Decoder> decoder_;
    std::uint64_t position_ = 0;
};

} // namespace

std::uint64_t file_bytes(const fs::path& path) {
    std::error_code failure;
    const fs::file_status status = fs::status(path, failure);
    if (!fs::exists(status))
        throw Error(fmt::format("{}: there is no such file", path.string()));
    if (fs::is_directory(status))
        throw Error(fmt::format("{}: a folder, expected a file", path.string()));
    if (!fs::is_regular_file(status))
        throw Error(fmt::format("{}: not a regular file", path.string()));
    const std::uint64_t bytes = fs::file_size(path, failure);
    if (failure)
        throw Error(fmt::format("{}: cannot be read: {}", path.string(), failure.message()));
    return bytes;
}

std::string head_of(const fs::path& path, std::size_t most) {
    const std::uint64_t size = file_bytes(path);
    const bool packed = is_gzip(path);
    std::string head(packed ? most : std::min<std::uint64_t>(size, most), '\0');
    std::ifstream in = open_file(path);
    if (!packed) {
        in.read(head.data(), static_cast<std::streamsize>(head.size()));
        head.resize(static_cast<std::size_t>(in.gcount()));
        return head;
    }
    // As much input as it takes: a name in the gzip header may be long, and what does not compress
    // grows.
    std::vector<char> chunk(4096);
    std::span<char> pending;
    Deflate decoder;
    std::span<std::byte> output = std::as_writable_bytes(std::span(head));
    while (!output.empty()) {
        if (pending.empty()) {
            in.read(chunk.data(), static_cast<std::streamsize>(chunk.size()));
            pending = std::span(chunk).first(static_cast<std::size_t>(in.gcount()));
        }
        const std::size_t had = pending.size(), wanted = output.size();
        if (!decoder.step(pending, output))
            throw Error(fmt::format("{}: damaged deflate data", path.string()));
        if (had == 0 && wanted == output.size())
            break;
    }
    head.resize(head.size() - output.size());
    return head;
}

bool is_gzip(const fs::path& path) {
    std::array<unsigned char, 2> magic{};
    std::ifstream in = open_file(path);
    in.read(reinterpret_cast<char*>(magic.data()), magic.size());
    return in && magic[0] == 0x1f && magic[1] == 0x8b;
}

void expect_room(const fs::path& path, std::uint64_t offset, Compression compression,
                 std::uint64_t bytes) {
    // Best ratios: deflate codes 258 bytes in 2 bits; bzip2 packs a 900 kB block of runs of 259.
    constexpr std::array<std::uint64_t, 3> kBestRatio{1, 1032, 2'000'000};
    const std::uint64_t size = file_bytes(path);
    const std::uint64_t rest = size > offset ? size - offset : 0;
    const std::uint64_t ratio = kBestRatio[static_cast<std::size_t>(compression)];
    if (offset > size || bytes / ratio > rest)
        throw Error(fmt::format("{}: truncated: {} bytes of data expected after byte {}, the file "
                                "has {} bytes{}",
                                path.string(), bytes, offset, size,
                                compression == Compression::none ? "" : " (compressed)"));
}

std::unique_ptr<DataStream> open_data(const fs::path& path, std::uint64_t offset,
                                      Compression compression) {
    file_bytes(path);
    switch (compression) {
    case Compression::deflate: return std::make_unique<CompressedData<Deflate>>(path, offset);
    case Compression::bzip2: return std::make_unique<CompressedData<Bzip2>>(path, offset);
    case Compression::none: break;
    }
    return std::make_unique<PlainData>(path, offset);
}

} // namespace isochron::index
