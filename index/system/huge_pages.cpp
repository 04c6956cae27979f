// Asks Linux for huge pages.
#include "index/system/huge_pages.h"

#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <new>

namespace isochron::index {
namespace {

constexpr std::size_t kHuge = 2 << 20;

} // namespace

void ask_for_huge_pages(const void* memory, std::size_t bytes) {
    const auto at = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t begin = (at + kHuge - 1) / kHuge * kHuge,
                         end = (at + bytes) / kHuge * kHuge;
    if (begin < end)
        ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

void FreeMemory::operator()(std::byte* memory) const {
    std::free(memory);
}

LargeMemory large_memory(std::size_t bytes) {
    const std::size_t alignment = bytes < 2 * kHuge ? 64 : kHuge;
    const std::size_t whole = (bytes + alignment - 1) / alignment * alignment;
    LargeMemory memory(
        static_cast<std::byte*>(std::aligned_alloc(alignment, whole > 0 ? whole : alignment)));
    if (!memory)
        throw std::bad_alloc();
    ask_for_huge_pages(memory.get(), whole);
    return memory;
}

} // namespace isochron::index
