// A cache of things that have been read and decoded, limited to a number of bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace isochron::index {

/// Drops what has not been used for longest. A dropped thing lives on while somebody holds it.
/// Thread-safe.
class ByteCache {
  public:
    struct Key {
        std::uint64_t high = 0, low = 0;
        bool operator==(const Key&) const = default;
    };
    struct Use {
        std::uint64_t budget = 0, held = 0; ///< bytes
        std::uint64_t hits = 0, misses = 0;
    };

    explicit ByteCache(std::uint64_t budget) : use_{.budget = budget} {}

    /// Null if it is not held. `T` must be the type that was added under the key.
    template <class T>
    std::shared_ptr<const T> find(const Key& key) {
        return std::static_pointer_cast<const T>(find_any(key));
    }
    /// Finds many keys at once, in their order.
    template <class T>
    std::vector<std::shared_ptr<const T>> find_all(std::span<const Key> keys) {
        std::vector<std::shared_ptr<const T>> found;
        found.reserve(keys.size());
        const std::scoped_lock lock(mutex_);
        for (const Key& key : keys)
            found.push_back(std::static_pointer_cast<const T>(take(key)));
        return found;
    }
    void add(const Key& key, std::shared_ptr<const void> value, std::uint64_t bytes) {
        add_all({{key, std::move(value), bytes}});
    }
    struct Entry {
        Key key;
        std::shared_ptr<const void> value;
        std::uint64_t bytes;
    };
    void add_all(std::vector<Entry> entries);
    /// Counts as a use of what is held under the keys, without returning it.
    void touch(std::span<const Key> keys);
    /// Which of the keys are held. Does not count as use.
    std::vector<bool> held(std::span<const Key> keys) const;
    Use use() const;
    /// Changes the budget. Entries beyond a smaller one are dropped when the next one is added.
    void limit(std::uint64_t budget) {
        const std::scoped_lock lock(mutex_);
        use_.budget = budget;
    }

  private:
    struct Hash {
        std::size_t operator()(const Key& key) const {
            return (key.high * 0x9e3779b97f4a7c15u) ^ (key.low * 0xc2b2ae3d27d4eb4fu);
        }
    };
    std::shared_ptr<const void> find_any(const Key& key) {
        const std::scoped_lock lock(mutex_);
        return take(key);
    }
    std::shared_ptr<const void> take(const Key& key); ///< with the lock held

    mutable std::mutex mutex_;
    Use use_;
    std::list<Entry> entries_; ///< the last used first
    std::unordered_map<Key, std::list<Entry>::iterator, Hash> by_key_;
};

} // namespace isochron::index
