// Keeps what was read of chunks, while it does not take too much memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace isochron::index {

/// Values by the place of their chunk; all are dropped when they would take more than `most` bytes.
template <class Value>
class ZarrCache {
  public:
    explicit ZarrCache(std::size_t most) : most_(most) {}

    /// Null: it is not kept. Valid until the next call of `keep`.
    const Value* find(const std::vector<std::uint64_t>& at) const {
        const auto found = kept_.find(at);
        return found == kept_.end() ? nullptr : &found->second;
    }
    /// Lets all go if so many bytes more are too many.
    void make_room(std::size_t bytes) {
        if (bytes_ + bytes <= most_)
            return;
        kept_.clear();
        bytes_ = 0;
    }
    const Value& keep(const std::vector<std::uint64_t>& at, Value value, std::size_t bytes) {
        make_room(bytes);
        bytes_ += bytes;
        return kept_[at] = std::move(value);
    }

  private:
    std::size_t most_, bytes_ = 0;
    std::map<std::vector<std::uint64_t>, Value> kept_;
};

} // namespace isochron::index
