// Reads files by position.
#include "index/system/byte_source.h"

#include "index/error.h"
#include "index/system/input_file.h"

#include <fmt/format.h>

#include <algorithm>

#include <fcntl.h>

namespace isochron::index {
namespace {

/// Most bytes that the kernel reads ahead for one call; it silently ignores the rest.
constexpr std::uint64_t kAdvised = 128 << 10;

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

  protected:
    std::size_t read_some(std::uint64_t offset, std::span<std::byte> out) const override {
        return file_.read(offset, out);
    }

  private:
    std::string name_;
    InputFile file_;
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
