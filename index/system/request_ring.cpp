// Fills and empties the queues of io_uring.
#include "index/system/request_ring.h"

#include <linux/io_uring.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/syscall.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <utility>

namespace isochron::index {
namespace {

constexpr unsigned kRequests = 64; ///< in a ring at a time
constexpr std::uint64_t kAnnounced = ~std::uint64_t{0};

std::atomic<unsigned> forks_of_process = 0; ///< so often was this process forked from another
[[maybe_unused]] const int counting_forks =
    ::pthread_atfork(nullptr, nullptr, [] { ++forks_of_process; });

/// Maps memory that a ring shares with the system. @return null if that fails
std::byte* map_of(int ring, std::size_t bytes, std::uint64_t part) {
    void* const memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE,
                                ring, static_cast<off_t>(part));
    return memory == MAP_FAILED ? nullptr : static_cast<std::byte*>(memory);
}

} // namespace

RequestRing::Memory::~Memory() {
    if (first)
        ::munmap(first, bytes);
}

RequestRing::~RequestRing() = default;

std::unique_ptr<RequestRing> RequestRing::make() {
    io_uring_params wanted{};
    Descriptor ring(static_cast<int>(::syscall(SYS_io_uring_setup, kRequests, &wanted)));
    if (!ring || !(wanted.features & IORING_FEAT_SINGLE_MMAP))
        return nullptr;
    std::unique_ptr<RequestRing> made(new RequestRing);
    Memory& queues = made->queues_;
    queues.bytes =
        std::max<std::size_t>(wanted.sq_off.array + wanted.sq_entries * sizeof(std::uint32_t),
                              wanted.cq_off.cqes + wanted.cq_entries * sizeof(io_uring_cqe));
    queues.first = map_of(ring.number(), queues.bytes, IORING_OFF_SQ_RING);
    made->entries_.bytes = wanted.sq_entries * sizeof(io_uring_sqe);
    made->entries_.first = map_of(ring.number(), made->entries_.bytes, IORING_OFF_SQES);
    if (!queues.first || !made->entries_.first)
        return nullptr;
    made->ring_ = std::move(ring);
    made->tail_at_ = wanted.sq_off.tail;
    made->mask_ = made->at(wanted.sq_off.ring_mask);
    made->answers_head_at_ = wanted.cq_off.head;
    made->answers_tail_at_ = wanted.cq_off.tail;
    made->answers_mask_ = made->at(wanted.cq_off.ring_mask);
    made->answers_at_ = wanted.cq_off.cqes;
    for (std::uint32_t i = 0; i < wanted.sq_entries; ++i) // entries are used in their order
        made->at(wanted.sq_off.array + 4 * i) = i;
    return made;
}

std::uint32_t& RequestRing::at(std::uint32_t offset) const {
    return *reinterpret_cast<std::uint32_t*>(queues_.first + offset);
}

/// Puts a request into the queue, which has room for it.
void RequestRing::put(std::uint8_t code, int file, std::uint64_t offset, std::byte* out,
                      std::uint32_t bytes, std::uint64_t request) {
    io_uring_sqe entry{};
    entry.opcode = code;
    entry.fd = file;
    entry.off = offset;
    entry.addr = reinterpret_cast<std::uint64_t>(out);
    entry.len = bytes;
    entry.user_data = request;
    if (code == IORING_OP_FADVISE)
        entry.fadvise_advice = POSIX_FADV_WILLNEED;
    std::memcpy(entries_.first + (tail_ & mask_) * sizeof entry, &entry, sizeof entry);
    ++tail_;
    ++put_;
}

/// Tells the system of what was put. @param wait_for so many answers
/// @return false: it failed, and what was not taken is no longer in the queue
bool RequestRing::enter(unsigned wait_for) {
    const std::atomic_ref tail(at(tail_at_));
    tail.store(tail_, std::memory_order_release);
    const long taken = ::syscall(SYS_io_uring_enter, ring_.number(), put_, wait_for,
                                 wait_for > 0 ? IORING_ENTER_GETEVENTS : 0, nullptr, 0);
    if (taken >= 0) {
        put_ -= static_cast<unsigned>(taken);
        under_way_ += static_cast<unsigned>(taken);
        return true;
    }
    if (errno == EINTR)
        return true;
    tail_ -= std::exchange(put_, 0); // the system looks at the queue inside the call only
    tail.store(tail_, std::memory_order_release);
    return false;
}

bool RequestRing::take(Answer& answer) {
    const std::uint32_t head = at(answers_head_at_);
    if (head == std::atomic_ref(at(answers_tail_at_)).load(std::memory_order_acquire))
        return false;
    io_uring_cqe entry;
    std::memcpy(&entry, queues_.first + answers_at_ + (head & answers_mask_) * sizeof entry,
                sizeof entry);
    std::atomic_ref(at(answers_head_at_)).store(head + 1, std::memory_order_release);
    answer = {entry.user_data, entry.res};
    --under_way_;
    refused_ |= entry.res == -EINVAL;
    return true;
}

bool RequestRing::announce(int file, std::span<const ByteRange> ranges) {
    while (!ranges.empty()) {
        for (Answer answer; take(answer);)
            continue;
        if (refused_)
            return false;
        const std::size_t count = std::min<std::size_t>(kRequests, ranges.size());
        for (const ByteRange& range : ranges.first(count))
            put(IORING_OP_FADVISE, file, range.offset, nullptr,
                static_cast<std::uint32_t>(range.bytes), kAnnounced);
        while (put_ > 0) // there is room for twice as many answers
            if (!enter(under_way_ > kRequests ? under_way_ : 0))
                return false;
        ranges = ranges.subspan(count);
    }
    return true;
}

void RequestRing::read(int file, std::span<const RangeRead> reads, std::span<std::size_t> got) {
    std::ranges::fill(got, std::size_t{0});
    for (std::size_t first = 0; first < reads.size() && !refused_;) {
        const std::size_t end = std::min<std::size_t>(first + kRequests, reads.size());
        for (std::size_t i = first; i < end; ++i)
            put(IORING_OP_READ, file, reads[i].offset, reads[i].out.data(),
                static_cast<std::uint32_t>(reads[i].out.size()), i);
        while (put_ + under_way_ > 0) { // nothing is written once this returns
            if (!enter(put_ + under_way_) && under_way_ > 0)
                ::sched_yield();
            for (Answer answer; take(answer);)
                if (answer.request < got.size() && answer.result > 0)
                    got[answer.request] = static_cast<std::size_t>(answer.result);
        }
        first = end;
    }
}

RequestRings::Ring RequestRings::take() {
    const std::scoped_lock lock(mutex_);
    if (forks_ != forks_of_process) { // the requests of the other process are none of this one's
        free_.clear();
        forks_ = forks_of_process;
    }
    if (refused_)
        return nullptr;
    if (free_.empty()) {
        Ring made = RequestRing::make();
        refused_ = !made;
        return made;
    }
    Ring ring = std::move(free_.back());
    free_.pop_back();
    return ring;
}

void RequestRings::give_back(Ring ring) {
    const std::scoped_lock lock(mutex_);
    free_.push_back(std::move(ring));
}

} // namespace isochron::index
