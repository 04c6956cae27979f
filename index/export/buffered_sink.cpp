// Collects what is written, and writes it in large pieces.
#include "index/export/buffered_sink.h"

#include <algorithm>
#include <vector>

namespace isochron::index {

void BufferedSink::bytes(std::span<const std::byte> added) {
    if (added.size() >= kAtOnce) {
        flush();
        sink_.write_at(at_, added);
        at_ += added.size();
        return;
    }
    if (waiting_ + added.size() > kAtOnce + kMost)
        flush();
    std::ranges::copy(added, &bytes_[waiting_]);
    waiting_ += added.size();
    if (waiting_ >= kAtOnce)
        flush();
}

void BufferedSink::copy(const ScratchFile& file, std::uint64_t count) {
    std::vector<std::byte> part(kAtOnce);
    for (std::uint64_t at = 0; at < count; at += part.size()) {
        const auto some = std::span(part).first(
            static_cast<std::size_t>(std::min<std::uint64_t>(part.size(), count - at)));
        file.read(at, some);
        bytes(some);
    }
}

void BufferedSink::align(std::size_t alignment) {
    while (size() % alignment != 0)
        put(std::byte{0});
}

void BufferedSink::flush() {
    sink_.write_at(at_, {bytes_.get(), waiting_});
    at_ += waiting_;
    waiting_ = 0;
}

} // namespace isochron::index
