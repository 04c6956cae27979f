// Large memory in large pages.
#pragma once

#include <cstddef>
#include <memory>

namespace isochron::index {

/// Asks for pages of 2 MiB where these bytes, which have not been touched, span some: a fraction of
/// the time that small ones take to come. Does nothing where the system has none.
void ask_for_huge_pages(const void* memory, std::size_t bytes);

struct FreeMemory {
    void operator()(std::byte* memory) const;
};
using LargeMemory = std::unique_ptr<std::byte[], FreeMemory>;
/// Memory whose content has no meaning, in large pages where it spans some. Aligned to 64 bytes, so
/// that vectors do not lie in two lines of a cache: a scan takes a tenth longer where they do.
/// @throws std::bad_alloc
LargeMemory large_memory(std::size_t bytes);

} // namespace isochron::index
