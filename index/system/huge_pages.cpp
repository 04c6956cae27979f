// What Linux is told of memory.
#include "index/system/huge_pages.h"

#include <sys/mman.h>

#include <cstdint>

namespace isochron::index {

void ask_for_huge_pages(const void* memory, std::size_t bytes) {
    constexpr std::uintptr_t kHuge = 2 << 20;
    const auto at = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t begin = (at + kHuge - 1) / kHuge * kHuge,
                         end = (at + bytes) / kHuge * kHuge;
    if (begin < end)
        ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

} // namespace isochron::index
