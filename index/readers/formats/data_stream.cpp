// Plain, deflate and bzip2 data behind one interface.
#include "index/readers/formats/data_stream.h"

#include "index/error.h"
#include "index/system/input_file.h"

#include <bzlib.h>
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kChunk = 1 << 18;

class PlainData final : public DataStream {
  public:
    PlainData(const fs::path& path, std::uint64_t offset)
        : name_(path.string()), offset_(offset), file_(path) {}

    void read(std::uint64_t position, std::span<std::byte> out) override {
        const std::uint64_t begin = offset_ + position;
        const std::size_t got = file_.read(begin, out);
        if (got < out.size())
            throw Error("{}: truncated: data end at byte {}, expected {}", name_, begin + got,
                        begin + out.size());
    }

    Rest rest(std::uint64_t position) override {
        const std::uint64_t begin = offset_ + position;
        return {.bytes = file_.size() > begin ? file_.size() - begin : 0};
    }

  private:
    std::string name_;
    std::uint64_t offset_;
    InputFile file_;
};

/// zlib's streaming interface; concatenated gzip members are read as one stream.
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

    /// Whether the last stream has ended and no other has begun.
    bool ended() const { return ended_; }
    /// Whether a gzip member begins so.
    static bool begins_with(char first) { return first == '\x1f'; }

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

    bool ended() const { return ended_; }
    static bool begins_with(char first) { return first == 'B'; }

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

class Hex {
  public:
    static constexpr const char* kName = "hex";
    bool ended() const { return !half_; }
    static bool begins_with(char) { return true; }

    bool step(std::span<char>& in, std::span<std::byte>& out) {
        while (!in.empty() && !out.empty()) {
            const char c = in.front();
            in = in.subspan(1);
            if (c == ' ' || c == '\n' || c == '\r' || c == '\t')
                continue;
            const char lower = static_cast<char>(c | 0x20);
            const bool letter = lower >= 'a' && lower <= 'f';
            if (!letter && !(c >= '0' && c <= '9'))
                return false;
            const int digit = letter ? lower - 'a' + 10 : c - '0';
            if (half_) {
                out.front() = static_cast<std::byte>(*half_ << 4 | digit);
                out = out.subspan(1);
                half_.reset();
            } else {
                half_ = digit;
            }
        }
        return true;
    }

  private:
    std::optional<int> half_; ///< the higher digit of a byte
};

template <class Decoder>
class CompressedData final : public DataStream {
  public:
    CompressedData(const fs::path& path, std::uint64_t offset)
        : name_(path.string()), offset_(offset), file_(path), chunk_(kChunk) {
        rewind();
    }

    void read(std::uint64_t position, std::span<std::byte> out) override {
        go_to(position);
        fill(out);
    }

    Rest rest(std::uint64_t position) override {
        go_to(position);
        std::vector<std::byte> decoded(kChunk);
        while (position_ - position < Rest::kMostCounted) {
            if (decoder_->ended() && has_input() && !Decoder::begins_with(pending_.front()))
                return {position_ - position, file_.size() - next_ + pending_.size()};
            std::span<std::byte> out(decoded);
            if (!advance(out))
                break;
        }
        return {.bytes = position_ - position};
    }

  private:
    void rewind() {
        next_ = offset_;
        decoder_.emplace();
        pending_ = {};
        position_ = 0;
    }

    void go_to(std::uint64_t position) {
        if (position < position_)
            rewind();
        std::vector<std::byte> skipped(std::min<std::uint64_t>(position - position_, kChunk));
        while (position_ < position)
            fill(std::span(skipped).first(
                std::min<std::uint64_t>(position - position_, skipped.size())));
    }

    void fill(std::span<std::byte> out) {
        const std::uint64_t end = position_ + out.size();
        while (!out.empty())
            if (!advance(out))
                fail_truncated(fmt::format("at least {}", end));
    }

    bool has_input() {
        if (pending_.empty()) {
            const std::size_t got = file_.read(next_, std::as_writable_bytes(std::span(chunk_)));
            pending_ = std::span(chunk_).first(got);
            next_ += got;
        }
        return !pending_.empty();
    }

    /// Decodes the next bytes into the front of `out`. @return false at the end of the data
    bool advance(std::span<std::byte>& out) {
        const bool fed = has_input();
        if (!fed && decoder_->ended())
            return false;
        const std::size_t room = out.size();
        const bool good = decoder_->step(pending_, out);
        position_ += room - out.size();
        if (!good)
            throw Error("{}: damaged {} data after {} decompressed bytes", name_, Decoder::kName,
                        position_);
        if (!fed && room == out.size() && !decoder_->ended())
            fail_truncated("the check that ends them");
        return true;
    }

    [[noreturn]] void fail_truncated(const std::string& expected) const {
        throw Error("{}: truncated: {} data end after {} bytes, expected {}", name_, Decoder::kName,
                    position_, expected);
    }

    std::string name_;
    std::uint64_t offset_;
    InputFile file_;
    std::uint64_t next_ = 0; ///< byte of the file to read next
    std::vector<char> chunk_;
    std::span<char> pending_;
    std::optional<Decoder> decoder_;
    std::uint64_t position_ = 0;
};

bool starts_as_gzip(const InputFile& file) {
    constexpr std::array kMagic{std::byte{0x1f}, std::byte{0x8b}};
    std::array<std::byte, kMagic.size()> start{};
    return file.read(0, start) == start.size() && start == kMagic;
}

} // namespace

std::uint64_t file_bytes(const fs::path& path) {
    return InputFile(path).size();
}

std::string head_of(const fs::path& path, std::size_t most) {
    const InputFile file(path);
    std::string head(most, '\0');
    std::span<std::byte> output = std::as_writable_bytes(std::span(head));
    if (!starts_as_gzip(file)) {
        head.resize(file.read(0, output));
        return head;
    }
    // Reads until the output is full: the name in a gzip header may be long, and data that do not
    // compress are longer when packed.
    std::vector<char> chunk(4096);
    std::span<char> pending;
    std::uint64_t next = 0;
    Deflate decoder;
    while (!output.empty()) {
        if (pending.empty()) {
            pending =
                std::span(chunk).first(file.read(next, std::as_writable_bytes(std::span(chunk))));
            next += pending.size();
        }
        const std::size_t had = pending.size(), wanted = output.size();
        if (!decoder.step(pending, output))
            throw Error("{}: damaged deflate data", path.string());
        if (had == 0 && wanted == output.size())
            break;
    }
    head.resize(head.size() - output.size());
    return head;
}

bool is_gzip(const fs::path& path) {
    return starts_as_gzip(InputFile(path));
}

void expect_room(const fs::path& path, std::uint64_t offset, Compression compression,
                 std::uint64_t bytes) {
    // Best ratios: deflate codes 258 bytes in 2 bits; bzip2 packs 900 kB blocks of runs of 259
    // bytes.
    constexpr std::array<std::uint64_t, 4> kBestRatio{1, 1032, 2'000'000, 1};
    const std::uint64_t size = file_bytes(path);
    const std::uint64_t rest = size > offset ? size - offset : 0;
    const std::uint64_t ratio = kBestRatio[static_cast<std::size_t>(compression)];
    if (offset > size || bytes / ratio > rest)
        throw Error(
            "{}: truncated: {} bytes of data expected after byte {}, the file has {} bytes{}",
            path.string(), bytes, offset, size,
            compression == Compression::none ? "" : " (compressed)");
}

std::unique_ptr<DataStream> open_data(const fs::path& path, std::uint64_t offset,
                                      Compression compression) {
    switch (compression) {
    case Compression::deflate: return std::make_unique<CompressedData<Deflate>>(path, offset);
    case Compression::hex: return std::make_unique<CompressedData<Hex>>(path, offset);
    case Compression::bzip2: return std::make_unique<CompressedData<Bzip2>>(path, offset);
    case Compression::none: break;
    }
    return std::make_unique<PlainData>(path, offset);
}

} // namespace isochron::index
