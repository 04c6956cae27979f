// Reads files by position.
#include "index/system/byte_source.h"

#include "index/error.h"
#include "index/system/input_file.h"
#include "index/system/request_ring.h"

#include <algorithm>
#include <mutex>
#include <vector>

#include <fcntl.h>

namespace isochron::index {
namespace {

/// Most bytes that the kernel reads ahead for one call; it silently ignores the rest.
constexpr std::uint64_t kAdvised = 128 << 10;
/// Bytes that are fetched between two looks at the stop token.
constexpr std::size_t kFetched = 1 << 20;

class OpenFile final : public ByteSource {
  public:
    OpenFile(const std::filesystem::path& path, const std::filesystem::path& name)
        : name_(name.string()), file_(path) {
        // Reads are scattered, so the kernel's own reading ahead would read unneeded bytes.
        ::posix_fadvise(file_.descriptor(), 0, 0, POSIX_FADV_RANDOM);
    }

    const std::string& name() const override { return name_; }
    std::uint64_t size() const override { return file_.size(); }
    void expect(std::uint64_t offset, std::uint64_t bytes) const override {
        for (const std::uint64_t end = offset + bytes; offset < end; offset += kAdvised)
            ::posix_fadvise(file_.descriptor(), static_cast<off_t>(offset),
                            static_cast<off_t>(std::min(end - offset, kAdvised)),
                            POSIX_FADV_WILLNEED);
    }

    void expect_each(std::span<const ByteRange> ranges) const override {
        RequestRings::Ring ring = ranges.size() > 1 ? announcing_.take() : nullptr;
        if (!ring)
            return ByteSource::expect_each(ranges);
        thread_local std::vector<ByteRange> advised;
        advised.clear();
        for (ByteRange range : ranges)
            for (const std::uint64_t end = range.offset + range.bytes; range.offset < end;
                 range.offset += kAdvised)
                advised.push_back({range.offset, std::min(end - range.offset, kAdvised)});
        if (!ring->announce(file_.descriptor(), advised))
            ByteSource::expect_each(ranges);
        announcing_.give_back(std::move(ring));
    }

    void fetch(std::uint64_t offset, std::uint64_t bytes,
               const std::stop_token& stop) const override {
        const InputFile* const file = in_order();
        if (!file)
            return expect(offset, bytes);
        thread_local std::vector<std::byte> unused;
        unused.resize(kFetched);
        try {
            for (const std::uint64_t end = offset + bytes;
                 offset < end && !stop.stop_requested();) {
                const std::size_t got = file->read(
                    offset,
                    std::span(unused).first(std::min<std::uint64_t>(kFetched, end - offset)));
                if (got == 0)
                    return;
                offset += got;
            }
        } catch (const Error&) { // whoever reads these bytes gets it, too
        }
    }

  protected:
    std::size_t read_some(std::uint64_t offset, std::span<std::byte> out) const override {
        return file_.read(offset, out);
    }
    std::size_t read_some_in_order(std::uint64_t offset, std::span<std::byte> out) const override {
        const InputFile* const file = in_order();
        return (file ? *file : file_).read(offset, out);
    }
    void read_together(std::span<const RangeRead> reads,
                       std::span<std::size_t> got) const override {
        if (RequestRings::Ring ring = reading_.take()) {
            ring->read(file_.descriptor(), reads, got);
            reading_.give_back(std::move(ring));
        }
    }

  private:
    /// The file without the advice above: the kernel reads ahead as it sees fit, in large requests
    /// and into large folios. Null if it cannot be opened again.
    const InputFile* in_order() const {
        std::call_once(opened_, [this] { in_order_ = file_.opened_again(); });
        return in_order_.get();
    }

    std::string name_;
    InputFile file_;
    mutable std::once_flag opened_;
    mutable std::unique_ptr<InputFile> in_order_;
    mutable RequestRings announcing_,
        reading_; ///< whoever reads does not wait for what is announced
};

} // namespace

void ByteSource::read(std::uint64_t offset, std::span<std::byte> out) const {
    read_all(&ByteSource::read_some, offset, out);
}

void ByteSource::read_each(std::span<const RangeRead> reads) const {
    thread_local std::vector<std::size_t> got;
    got.assign(reads.size(), 0);
    if (reads.size() > 1)
        read_together(reads, got);
    for (std::size_t i = 0; i < reads.size(); ++i) {
        bytes_read_ += got[i];
        read(reads[i].offset + got[i], reads[i].out.subspan(got[i]));
    }
}

void ByteSource::expect_each(std::span<const ByteRange> ranges) const {
    for (const ByteRange& range : ranges)
        expect(range.offset, range.bytes);
}

void ByteSource::read_in_order(std::uint64_t offset, std::span<std::byte> out) const {
    read_all(&ByteSource::read_some_in_order, offset, out);
}

void ByteSource::read_all(Some some, std::uint64_t offset, std::span<std::byte> out) const {
    while (!out.empty()) {
        const std::size_t count = (this->*some)(offset, out);
        if (count == 0)
            throw Error("{}: truncated: nothing at byte {}, it had {} bytes when it was opened",
                        name(), offset, size());
        bytes_read_ += count;
        offset += count;
        out = out.subspan(count);
    }
}

std::unique_ptr<ByteSource> open_local_bytes(const std::filesystem::path& path,
                                             const std::filesystem::path& name) {
    return std::make_unique<OpenFile>(path, name);
}

} // namespace isochron::index
