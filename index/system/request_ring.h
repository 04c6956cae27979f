// Many requests for bytes of files in one call of the system: Linux's io_uring.
#pragma once

#include "index/system/byte_range.h"
#include "index/system/descriptor.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace isochron::index {

/// A queue of requests that this process shares with the system. For one thread at a time.
class RequestRing {
  public:
    /// Null where the system has none, or refuses it: many machines of several users do.
    static std::unique_ptr<RequestRing> make();
    ~RequestRing();
    RequestRing(const RequestRing&) = delete;
    RequestRing& operator=(const RequestRing&) = delete;

    /// Announces bytes of a file, as POSIX_FADV_WILLNEED does, and does not wait.
    /// @return false: the system knows no such request, and all should be announced by other means
    bool announce(int file, std::span<const ByteRange> ranges);
    /// Reads, and waits until all is there. @param got as long as `reads`; set to the bytes read of
    /// each, which may be fewer than asked for, and none where a read failed
    void read(int file, std::span<const RangeRead> reads, std::span<std::size_t> got);

  private:
    struct Memory {
        std::byte* first = nullptr;
        std::size_t bytes = 0;
        ~Memory();
    };
    struct Answer {
        std::uint64_t request;
        std::int32_t result;
    };

    RequestRing() = default;
    void put(std::uint8_t code, int file, std::uint64_t offset, std::byte* out, std::uint32_t bytes,
             std::uint64_t request);
    bool enter(unsigned wait_for);
    bool take(Answer& answer);
    std::uint32_t& at(std::uint32_t offset) const;

    Descriptor ring_;
    Memory queues_, entries_;
    std::uint32_t tail_ = 0, mask_ = 0, tail_at_ = 0;
    std::uint32_t answers_mask_ = 0, answers_head_at_ = 0, answers_tail_at_ = 0, answers_at_ = 0;
    unsigned put_ = 0;       ///< requests that the system has not been told of
    unsigned under_way_ = 0; ///< requests that have not been answered
    bool refused_ = false;   ///< a request was unknown to the system
};

/// Rings that several threads use in turn; none at all where the system has none. A process that was
/// forked makes its own. Thread-safe.
class RequestRings {
  public:
    using Ring = std::unique_ptr<RequestRing>;
    Ring take(); ///< null: there are none
    void give_back(Ring ring);

  private:
    std::mutex mutex_;
    std::vector<Ring> free_;
    unsigned forks_ = 0;
    bool refused_ = false;
};

} // namespace isochron::index
