// Memory of large vectors that is used again: the system clears new memory page by page, which takes
// a fifth of the time in which a large mesh is made.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace isochron::index {

#ifndef __wasm__ // which has no pages

/// At least so many bytes of a vector come from memory that is kept.
constexpr std::size_t kLeastKeptBytes = 256 << 10;

/// Memory with undefined contents, aligned to a page: what was given back before, or new. Thread-safe.
/// @param bytes at least kLeastKeptBytes @throws std::bad_alloc
void* take_kept(std::size_t bytes);
/// @param memory from `take_kept`, with the same number of bytes. It is kept for the next use, while
///        all that is kept takes 512 MiB at most.
void give_back_kept(void* memory, std::size_t bytes) noexcept;
/// Gives what is kept and not in use back to the system: for whoever has had nothing to do for a
/// while. @return bytes that were given back
std::size_t free_kept() noexcept;

/// An allocator for vectors of numbers, or of what is made of them. Values that a vector adds by
/// `resize` without a value are undefined, as nobody reads them before they are written.
template <class T>
struct KeptAllocator {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
    using value_type = T;
    KeptAllocator() = default;
    template <class Other>
    KeptAllocator(const KeptAllocator<Other>&) {}

    T* allocate(std::size_t count) {
        const std::size_t bytes = count * sizeof(T);
        return bytes < kLeastKeptBytes ? std::allocator<T>().allocate(count)
                                  : static_cast<T*>(take_kept(bytes));
    }
    void deallocate(T* memory, std::size_t count) noexcept {
        if (count * sizeof(T) < kLeastKeptBytes)
            std::allocator<T>().deallocate(memory, count);
        else
            give_back_kept(memory, count * sizeof(T));
    }
    void construct(T*) const {}
    template <class... Values>
    void construct(T* at, Values&&... values) const {
        std::construct_at(at, std::forward<Values>(values)...);
    }
    friend bool operator==(const KeptAllocator&, const KeptAllocator&) { return true; }
};

template <class T>
using KeptVector = std::vector<T, KeptAllocator<T>>;

#else

template <class T>
using KeptVector = std::vector<T>;

#endif

} // namespace isochron::index
