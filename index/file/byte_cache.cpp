// Eviction of what was not used for longest.
#include "index/file/byte_cache.h"

#include <vector>

namespace isochron::index {

std::shared_ptr<const void> ByteCache::find_any(const Key& key) {
    const std::scoped_lock lock(mutex_);
    const auto found = by_key_.find(key);
    ++(found == by_key_.end() ? use_.misses : use_.hits);
    if (found == by_key_.end())
        return nullptr;
    entries_.splice(entries_.begin(), entries_, found->second);
    return found->second->value;
}

void ByteCache::add(const Key& key, std::shared_ptr<const void> value, std::uint64_t bytes) {
    std::vector<std::shared_ptr<const void>> dropped; // freed after the lock
    const std::scoped_lock lock(mutex_);
    if (by_key_.contains(key)) // somebody else was faster
        return;
    entries_.push_front({key, std::move(value), bytes});
    by_key_[key] = entries_.begin();
    use_.held += bytes;
    while (use_.held > use_.budget) {
        Entry& last = entries_.back();
        use_.held -= last.bytes;
        dropped.push_back(std::move(last.value));
        by_key_.erase(last.key);
        entries_.pop_back();
    }
}

ByteCache::Use ByteCache::use() const {
    const std::scoped_lock lock(mutex_);
    return use_;
}

} // namespace isochron::index
