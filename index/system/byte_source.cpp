// Reads files by position.
#include "index/system/byte_source.h"

#include "index/error.h"
#include "index/system/descriptor.h"
#include "index/system/input_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <mutex>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

namespace isochron::index {
namespace {

/// Most bytes that the kernel reads ahead for one call; it silently ignores the rest.
constexpr std::uint64_t kAdvised = 128 << 10;
/// Bytes that are fetched between two looks at the stop token.
constexpr std::size_t kFetched = 1 << 20;

class OpenFile final : public ByteSource {
  public:
    explicit OpenFile(const std::filesystem::path& path) : name_(path.string()), file_(path) {
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

    void fetch(std::uint64_t offset, std::uint64_t bytes,
               const std::stop_token& stop) const override {
        // Advice holds for a description of the file, so this one has its own, on which the kernel
        // reads ahead as it sees fit: in large requests, and into large folios.
        std::call_once(opened_, [this] {
            const std::string same = fmt::format("/proc/self/fd/{}", file_.descriptor());
            in_order_ = Descriptor(::open(same.c_str(), O_RDONLY | O_CLOEXEC));
        });
        if (!in_order_)
            return expect(offset, bytes);
        thread_local std::vector<std::byte> unused;
        unused.resize(kFetched);
        for (const std::uint64_t end = offset + bytes; offset < end && !stop.stop_requested();) {
            const ssize_t got = ::pread(in_order_.number(), unused.data(),
                                        std::min<std::uint64_t>(kFetched, end - offset),
                                        static_cast<off_t>(offset));
            if (got == 0 || (got < 0 && errno != EINTR))
                return;
            offset += static_cast<std::uint64_t>(std::max<ssize_t>(got, 0));
        }
    }

  protected:
    std::size_t read_some(std::uint64_t offset, std::span<std::byte> out) const override {
        return file_.read(offset, out);
    }

  private:
    std::string name_;
    InputFile file_;
    mutable std::once_flag opened_;
    mutable Descriptor in_order_; ///< of the same file
};

} // namespace

void ByteSource::read(std::uint64_t offset, std::span<std::byte> out) const {
    while (!out.empty()) {
        const std::size_t count = read_some(offset, out);
        if (count == 0)
            throw Error(fmt::format("{}: truncated: nothing at byte {}, it had {} bytes when it "
                                    "was opened",
                                    name(), offset, size()));
        bytes_read_ += count;
        offset += count;
        out = out.subspan(count);
    }
}

std::unique_ptr<ByteSource> open_bytes(const std::filesystem::path& path) {
    return std::make_unique<OpenFile>(path);
}

} // namespace isochron::index
