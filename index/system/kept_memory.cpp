// Keeps blocks by their sizes.
#include "index/system/kept_memory.h"

#include <sys/mman.h>

#include <bit>
#include <map>
#include <mutex>
#include <new>

namespace isochron::index {
namespace {

constexpr std::size_t kMostKept = 512 << 20;

/// A vector of nearly the same length gets the same block: sizes are rounded up to an eighth of the
/// power of two below them. What is too much is never touched, and takes no memory.
std::size_t block_of(std::size_t bytes) {
    const std::size_t unit = std::bit_floor(bytes) / 8;
    return (bytes + unit - 1) / unit * unit;
}

/// The blocks that are not in use. It is never destroyed, as vectors may outlive all else.
struct Kept {
    std::mutex mutex;
    std::multimap<std::size_t, void*> free; ///< by size
    std::size_t bytes = 0;
};
Kept& kept() {
    static Kept* const blocks = new Kept;
    return *blocks;
}

} // namespace

void* take_kept(std::size_t bytes) {
    const std::size_t size = block_of(bytes);
    Kept& blocks = kept();
    {
        const std::scoped_lock lock(blocks.mutex);
        if (const auto found = blocks.free.find(size); found != blocks.free.end()) {
            void* const memory = found->second;
            blocks.free.erase(found);
            blocks.bytes -= size;
            return memory;
        }
    }
    const auto map = [&] {
        return ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    };
    void* memory = map();
    if (memory == MAP_FAILED && free_kept() > 0) // where memory is limited, blocks of other sizes
        memory = map();
    if (memory == MAP_FAILED)
        throw std::bad_alloc();
    return memory;
}

void give_back_kept(void* memory, std::size_t bytes) noexcept {
    const std::size_t size = block_of(bytes);
    Kept& blocks = kept();
    try {
        const std::scoped_lock lock(blocks.mutex);
        if (blocks.bytes + size <= kMostKept) {
            blocks.free.emplace(size, memory);
            blocks.bytes += size;
            return;
        }
    } catch (const std::bad_alloc&) { // for the place in the list
    }
    ::munmap(memory, size);
}

std::size_t free_kept() noexcept {
    std::multimap<std::size_t, void*> all;
    Kept& blocks = kept();
    {
        const std::scoped_lock lock(blocks.mutex);
        all.swap(blocks.free);
        blocks.bytes = 0;
    }
    std::size_t bytes = 0;
    for (const auto& [size, memory] : all) {
        ::munmap(memory, size);
        bytes += size;
    }
    return bytes;
}

} // namespace isochron::index
