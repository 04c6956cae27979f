// A part of a file at a fixed address in memory, whose pages are read when they are first needed.
#pragma once

#include "index/system/byte_source.h"

#include <atomic>
#include <memory>
#include <mutex>

namespace isochron::index {

/// Takes address space for the whole part, but memory only for the pages that were needed.
/// Thread-safe. The source must outlive it.
class LazyPart {
  public:
    /// @throws Error when there is no address space
    LazyPart(const ByteSource& source, std::uint64_t offset, std::uint64_t bytes);
    ~LazyPart();
    LazyPart(const LazyPart&) = delete;
    LazyPart& operator=(const LazyPart&) = delete;

    /// The whole part; its address never changes. Bytes that were not needed yet may be zero.
    std::span<const std::byte> bytes() const { return {memory_, bytes_}; }
    /// Reads the missing pages of a part of `bytes()`. @throws Error as the source does
    void need(std::span<const std::byte> part) const;
    /// Bytes that `need` would read.
    std::uint64_t missing(std::span<const std::byte> part) const;
    /// Announces that a part will be needed soon.
    void expect(std::span<const std::byte> part) const;
    /// Number of bytes in memory.
    std::uint64_t held() const { return held_; }
    /// Gives the memory back; nobody may be using it. Pages that are needed again are read again.
    void drop() const;

  private:
    bool has(std::uint64_t page) const {
        return present_[page / 64].load(std::memory_order_acquire) >> page % 64 & 1;
    }
    std::uint64_t words() const;

    const ByteSource& source_;
    std::uint64_t offset_, bytes_;
    std::byte* memory_ = nullptr;
    std::unique_ptr<std::atomic<std::uint64_t>[]> present_; ///< a bit for each page
    mutable std::atomic<std::uint64_t> held_{0};
    mutable std::mutex reading_;
};

} // namespace isochron::index
