// Reads pages of a part of a file, once each.
#include "index/system/lazy_part.h"

#include "index/error.h"

#include <fmt/format.h>

#include <sys/mman.h>

#include <algorithm>

namespace isochron::index {
namespace {

constexpr std::uint64_t kPage = 4096;

} // namespace

LazyPart::LazyPart(const ByteSource& source, std::uint64_t offset, std::uint64_t bytes)
    : source_(source), offset_(offset), bytes_(bytes),
      present_(std::make_unique<std::atomic<std::uint64_t>[]>(words())) {
    if (bytes == 0)
        return;
    void* memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                          MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED)
        throw Error(fmt::format("{}: no address space for {} bytes", source.name(), bytes));
    memory_ = static_cast<std::byte*>(memory);
}

LazyPart::~LazyPart() {
    if (memory_)
        ::munmap(memory_, bytes_);
}

std::uint64_t LazyPart::words() const {
    return (bytes_ + kPage * 64 - 1) / (kPage * 64);
}

void LazyPart::need(std::span<const std::byte> part) const {
    if (part.empty())
        return;
    const auto begin = static_cast<std::uint64_t>(part.data() - memory_);
    const std::uint64_t last = (begin + part.size() - 1) / kPage;
    /// The first page from `page` on that is present, or not present; 1 + `last` if there is none.
    const auto next = [&](std::uint64_t page, bool present) {
        while (page <= last && has(page) != present)
            ++page;
        return page;
    };
    std::uint64_t page = next(begin / kPage, false);
    if (page > last)
        return;
    const std::scoped_lock lock(reading_);
    while ((page = next(page, false)) <= last) {
        const std::uint64_t first = page;
        page = next(page, true);
        const std::uint64_t from = first * kPage, to = std::min(page * kPage, bytes_);
        source_.read(offset_ + from, {memory_ + from, to - from});
        for (std::uint64_t read = first; read < page; ++read)
            present_[read / 64].fetch_or(std::uint64_t{1} << read % 64, std::memory_order_release);
        held_ += to - from;
    }
}

std::uint64_t LazyPart::missing(std::span<const std::byte> part) const {
    if (part.empty())
        return 0;
    const auto begin = static_cast<std::uint64_t>(part.data() - memory_);
    std::uint64_t bytes = 0;
    for (std::uint64_t page = begin / kPage; page * kPage < begin + part.size(); ++page)
        bytes += has(page) ? 0 : std::min((page + 1) * kPage, bytes_) - page * kPage;
    return bytes;
}

void LazyPart::expect(std::span<const std::byte> part) const {
    const auto begin = static_cast<std::uint64_t>(part.data() - memory_);
    if (!part.empty() && !has(begin / kPage))
        source_.expect(offset_ + begin, part.size());
}

void LazyPart::drop() const {
    if (held_ == 0)
        return;
    ::madvise(memory_, bytes_, MADV_DONTNEED);
    for (std::uint64_t word = 0; word < words(); ++word)
        present_[word].store(0, std::memory_order_release);
    held_ = 0;
}

} // namespace isochron::index
