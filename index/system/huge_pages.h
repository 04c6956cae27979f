// Asks the system for huge pages for large memory.
#pragma once

#include <cstddef>
#include <memory>

namespace isochron::index {

/// Asks for pages of 2 MiB inside this memory, which must not have been touched yet. They are
/// allocated in a fraction of the time of small pages. Does nothing if the system has none.
void ask_for_huge_pages(const void* memory, std::size_t bytes);

struct FreeMemory {
    void operator()(std::byte* memory) const;
};
using LargeMemory = std::unique_ptr<std::byte[], FreeMemory>;
/// Allocates memory with undefined contents, in huge pages if it is large enough. It is aligned to
/// 64 bytes, so that no vector lies in two cache lines, which would make a scan a tenth slower.
/// @throws std::bad_alloc
LargeMemory large_memory(std::size_t bytes);

} // namespace isochron::index
