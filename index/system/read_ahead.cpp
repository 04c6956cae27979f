// Announces reads far enough ahead to keep a disk busy, but not so far that pages are evicted
// before they are needed.
#include "index/system/read_ahead.h"

#include <utility>

namespace isochron::index {
namespace {

/// Bytes that are announced before they are needed: they keep a disk busy for some milliseconds, so
/// that a read that was not foreseen waits no longer than that.
constexpr std::uint64_t kAhead = 4 << 20;

} // namespace

ReadAhead::ReadAhead(std::uint32_t parts, Ask ask)
    : ask_(std::move(ask)), asked_(parts),
      asking_([this](const std::stop_token& stop) { run(stop); }) {}

ReadAhead::~ReadAhead() = default;

void ReadAhead::run(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    const auto wanted = [this] { return next_ <= reached_ || ahead_ < kAhead; };
    while (next_ < asked_.size() && reached_more_.wait(lock, stop, wanted)) {
        if (stop.stop_requested())
            return;
        const std::uint32_t part = next_;
        lock.unlock();
        std::uint64_t bytes = 0;
        try {
            bytes = ask_(part);
        } catch (...) {
            return;
        }
        lock.lock();
        asked_[part] = bytes;
        if (part >= reached_)
            ahead_ += bytes;
        ++next_;
    }
}

void ReadAhead::reach(std::uint32_t part) {
    {
        const std::scoped_lock lock(mutex_);
        for (; reached_ <= part; ++reached_)
            if (reached_ < next_)
                ahead_ -= asked_[reached_];
    }
    reached_more_.notify_one();
}

} // namespace isochron::index
