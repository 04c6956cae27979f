// Blocks of slots, each with a list of its free slots.
#include "index/system/slot_pool.h"

#include "index/system/huge_pages.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <span>

#include <sanitizer/asan_interface.h>

namespace isochron::index {
namespace {

constexpr std::size_t kBlock = 2 << 20, kSlotAlignment = 64, kSmallPage = 4096;
constexpr std::size_t kTogether = 64 << 10; ///< [bytes] of pages allocated at a time
/// Blocks of a pool whose pages are allocated as slots are taken: a small pool needs no more.
constexpr std::size_t kGradual = 2;

} // namespace

/// The head of a block, at the beginning of the block's memory.
struct alignas(kSlotAlignment) SlotPool::Block {
    std::byte* next = nullptr;  ///< the first free slot; a free slot holds the address of the next
    std::byte* fresh = nullptr; ///< slots from here on have never been used
    std::byte* there = nullptr; ///< pages from here on have not been allocated
    std::size_t used = 0;

    static Block* make() { return begin(memory()); }
    /// A block with all its pages.
    static Block* make_whole(PageSizeTrials& trials) {
        void* const memory = Block::memory();
        const Pages pages = trials.next();
        const auto started = std::chrono::steady_clock::now();
        const std::span bytes(static_cast<std::byte*>(memory), kBlock);
        if (pages == Pages::huge)
            ask_for_huge_pages(memory, kBlock);
        else
            fetch_pages(bytes);
        for (std::size_t at = 0; at < kBlock; at += kSmallPage)
            bytes[at] = std::byte{0}; // a virtual machine may wait here once more
        trials.took(pages, std::chrono::steady_clock::now() - started);
        Block* const block = begin(memory);
        block->there = block->end();
        return block;
    }
    static void* memory() {
        void* const memory = std::aligned_alloc(kBlock, kBlock);
        if (!memory)
            throw std::bad_alloc();
        return memory;
    }
    static Block* begin(void* memory) {
        auto* const block = new (memory) Block;
        block->there = reinterpret_cast<std::byte*>(block);
        block->fresh = reinterpret_cast<std::byte*>(block + 1);
        // Under AddressSanitizer, reading an unused slot is an error.
        ASAN_POISON_MEMORY_REGION(block->fresh, block->end() - block->fresh);
        return block;
    }
    static Block* of(std::byte* slot) {
        return reinterpret_cast<Block*>(reinterpret_cast<std::uintptr_t>(slot) / kBlock * kBlock);
    }
    std::byte* end() { return reinterpret_cast<std::byte*>(this) + kBlock; }
    bool full(std::size_t slot) { return !next && static_cast<std::size_t>(end() - fresh) < slot; }
    std::byte* take(std::size_t slot) {
        ++used;
        if (std::byte* const found = next) {
            ASAN_UNPOISON_MEMORY_REGION(found, slot);
            next = *std::launder(reinterpret_cast<std::byte**>(found));
            return found;
        }
        fresh += slot;
        ASAN_UNPOISON_MEMORY_REGION(fresh - slot, slot);
        return fresh - slot;
    }
};

SlotPool::SlotPool(std::size_t bytes, PageSizeTrials& trials)
    : bytes_((bytes + kSlotAlignment - 1) / kSlotAlignment * kSlotAlignment), trials_(trials) {
    assert(bytes > 0 && bytes <= kBlock / 2);
}

SlotPool::~SlotPool() {
    for (Block* const block : free_) {
        ASAN_UNPOISON_MEMORY_REGION(block, kBlock);
        std::free(block);
    }
}

std::byte* SlotPool::take() {
    std::byte *slot = nullptr, *begin = nullptr, *end = nullptr;
    {
        std::unique_lock lock(mutex_);
        if (free_.empty()) {
            Block* made = nullptr;
            if (blocks_ < kGradual) {
                made = Block::make();
            } else { // takes time, in which other threads give slots back, or make blocks, too
                lock.unlock();
                made = Block::make_whole(trials_);
                lock.lock();
            }
            free_.push_back(made);
            ++blocks_;
        }
        Block* const block = free_.back();
        slot = block->take(bytes_);
        if (block->full(bytes_))
            free_.pop_back();
        if (slot + bytes_ > block->there) {
            begin = block->there;
            const auto more = static_cast<std::size_t>(slot + bytes_ - begin) + kTogether;
            end = begin + std::min(more / kSmallPage * kSmallPage,
                                   static_cast<std::size_t>(block->end() - begin));
            block->there = end;
        }
    }
    if (begin)
        fetch_pages({begin, end});
    return slot;
}

void SlotPool::give_back(std::byte* slot) {
    Block* empty = nullptr;
    {
        const std::scoped_lock lock(mutex_);
        Block* const block = Block::of(slot);
        if (block->full(bytes_))
            free_.push_back(block);
        new (slot) std::byte*(block->next);
        block->next = slot;
        ASAN_POISON_MEMORY_REGION(slot, bytes_);
        if (--block->used == 0 && free_.size() > 1) {
            std::erase(free_, block);
            empty = block;
            ASAN_UNPOISON_MEMORY_REGION(block, kBlock);
            --blocks_;
        }
    }
    std::free(empty);
}

std::size_t SlotPool::bytes() const {
    const std::scoped_lock lock(mutex_);
    return blocks_ * kBlock;
}

} // namespace isochron::index
