// How far ahead: enough for a disk to be busy, little enough to be still there when it is wanted.
#include "index/system/read_ahead.h"

#include <utility>

namespace isochron::index {
namespace {

/// Bytes that are asked for before they are needed.
constexpr std::uint64_t kAhead = 16 << 20;

} // namespace

ReadAhead::ReadAhead(std::uint32_t parts, Ask ask) : ask_(std::move(ask)), asked_(parts) {}

void ReadAhead::reach(std::uint32_t part) {
    const std::scoped_lock lock(mutex_);
    for (; reached_ < part && reached_ < next_; ++reached_)
        ahead_ -= asked_[reached_];
    for (; next_ < asked_.size() && (next_ <= part + 1 || ahead_ < kAhead); ++next_) {
        asked_[next_] = ask_(next_);
        ahead_ += asked_[next_];
    }
}

} // namespace isochron::index
