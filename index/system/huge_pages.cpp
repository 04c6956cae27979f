// Asks Linux for pages.
#include "index/system/huge_pages.h"

#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <new>

namespace isochron::index {
namespace {

constexpr std::size_t kHuge = 2 << 20, kSmall = 4096;

} // namespace

void ask_for_huge_pages(const void* memory, std::size_t bytes) {
    const auto at = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t begin = (at + kHuge - 1) / kHuge * kHuge,
                         end = (at + bytes) / kHuge * kHuge;
    if (begin < end)
        ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

void fetch_pages(std::span<std::byte> memory) {
#ifdef MADV_POPULATE_WRITE
    const auto at = reinterpret_cast<std::uintptr_t>(memory.data());
    const std::uintptr_t begin = at / kSmall * kSmall;
    ::madvise(reinterpret_cast<void*>(begin), at + memory.size() - begin, MADV_POPULATE_WRITE);
#else
    static_cast<void>(memory);
#endif
}

bool last_page_is_there(std::span<const std::byte> memory) {
    const auto end = reinterpret_cast<std::uintptr_t>(memory.data()) + memory.size();
    unsigned char there = 0;
    return memory.empty() ||
           ::mincore(reinterpret_cast<void*>((end - 1) / kSmall * kSmall), 1, &there) != 0 ||
           (there & 1) != 0;
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
