// Evicts entries that have not been used for longest.
#include "index/file/chunks/byte_cache.h"

namespace isochron::index {

std::shared_ptr<const void> ByteCache::take(const Key& key) {
    const auto found = by_key_.find(key);
    ++(found == by_key_.end() ? use_.misses : use_.hits);
    if (found == by_key_.end())
        return nullptr;
    entries_.splice(entries_.begin(), entries_, found->second);
    return found->second->value;
}

void ByteCache::add_all(std::vector<Entry> entries) {
    std::vector<std::shared_ptr<const void>> dropped; // freed after the lock
    const std::scoped_lock lock(mutex_);
    for (Entry& entry : entries) {
        if (by_key_.contains(entry.key)) // another thread was faster
            continue;
        use_.held += entry.bytes;
        entries_.push_front(std::move(entry));
        by_key_[entries_.front().key] = entries_.begin();
    }
    while (use_.held > use_.budget) {
        Entry& last = entries_.back();
        use_.held -= last.bytes;
        dropped.push_back(std::move(last.value));
        by_key_.erase(last.key);
        entries_.pop_back();
    }
}

void ByteCache::touch(std::span<const Key> keys) {
    const std::scoped_lock lock(mutex_);
    for (const Key& key : keys)
        if (const auto found = by_key_.find(key); found != by_key_.end())
            entries_.splice(entries_.begin(), entries_, found->second);
}

std::vector<bool> ByteCache::held(std::span<const Key> keys) const {
    std::vector<bool> held(keys.size());
    const std::scoped_lock lock(mutex_);
    for (std::size_t i = 0; i < keys.size(); ++i)
        held[i] = by_key_.contains(keys[i]);
    return held;
}

ByteCache::Use ByteCache::use() const {
    const std::scoped_lock lock(mutex_);
    return use_;
}

} // namespace isochron::index
