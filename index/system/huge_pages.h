// Asks the system for the pages of large memory: huge ones, or small ones together.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace isochron::index {

/// Asks for pages of 2 MiB inside this memory, which must not have been touched yet. They are
/// allocated in a fraction of the time of small pages. Does nothing if the system has none.
void ask_for_huge_pages(const void* memory, std::size_t bytes);

/// Allocates the small pages of memory together, since allocating each at its first touch takes
/// longer. Does nothing where they are there, and where the system cannot. A huge page would take
/// half of that time on a physical machine. But a virtual machine may have returned its free huge
/// pages to the host, and would wait for them.
void fetch_pages(std::span<std::byte> memory);

/// Whether the last page has been touched before: `fetch_pages` of memory that is all there takes a
/// third of the time of a copy. True where the system does not say.
bool last_page_is_there(std::span<const std::byte> memory);

/// Makes room for so many values in an empty vector, and fetches the pages that it does not have yet.
template <class T>
void make_room(std::vector<T>& empty, std::size_t count) {
    if (empty.capacity() >= count)
        return;
    empty.reserve(count);
    fetch_pages({reinterpret_cast<std::byte*>(empty.data()), count * sizeof(T)});
}

struct FreeMemory {
    void operator()(std::byte* memory) const;
};
using LargeMemory = std::unique_ptr<std::byte[], FreeMemory>;
/// Allocates memory with undefined contents, in huge pages if it is large enough. It is aligned to
/// 64 bytes, so that no vector lies in two cache lines, which would make a scan a tenth slower.
/// @throws std::bad_alloc
LargeMemory large_memory(std::size_t bytes);

} // namespace isochron::index
