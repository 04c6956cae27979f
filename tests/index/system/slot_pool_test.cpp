// The pool of slots: no slot is given out twice, memory is reused, and is released.
#include "index/system/slot_pool.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <random>
#include <thread>
#include <vector>

namespace isochron::index {
namespace {

TEST(SlotPool, GivesSlotsThatKeepWhatIsPutThere) {
    for (const std::size_t bytes : {1, 64, 100, 4192, 32864, 1 << 20}) {
        SlotPool pool(bytes);
        struct Held {
            std::byte* slot;
            std::byte mark;
        };
        std::vector<Held> held;
        std::mt19937 random(7);
        const auto check = [&](const Held& one) {
            EXPECT_EQ(reinterpret_cast<std::uintptr_t>(one.slot) % 64, 0u);
            EXPECT_TRUE(std::all_of(one.slot, one.slot + bytes,
                                    [&](std::byte b) { return b == one.mark; }));
        };
        for (int i = 0; i < (bytes > 4096 ? 60 : 300); ++i) {
            if (held.empty() || random() % 3 > 0) {
                held.push_back({pool.take(), static_cast<std::byte>(i)});
                std::memset(held.back().slot, i & 255, bytes);
            } else {
                std::swap(held[random() % held.size()], held.back());
                check(held.back());
                pool.give_back(held.back().slot);
                held.pop_back();
            }
        }
        for (const Held& one : held) {
            check(one);
            pool.give_back(one.slot);
        }
    }
}

TEST(SlotPool, UsesMemoryAgainAndKeepsNoMoreThanABlockOfWhatIsFree) {
    SlotPool pool(4096);
    EXPECT_EQ(pool.bytes(), 0u);
    std::vector<std::byte*> slots(2000);
    std::size_t most = 0;
    for (int round = 0; round < 3; ++round) {
        std::ranges::generate(slots, [&] { return pool.take(); });
        std::ranges::sort(slots);
        EXPECT_EQ(std::ranges::adjacent_find(slots), slots.end());
        most = most ? most : pool.bytes();
        EXPECT_EQ(pool.bytes(), most);
        EXPECT_LT(most, slots.size() * 4096 + (4 << 20));
        for (std::byte* slot : slots)
            pool.give_back(slot);
        EXPECT_EQ(pool.bytes(), std::size_t{2} << 20);
    }
}

TEST(SlotPool, MeasuresBlocksOnlyWhereThereAreMany) {
    PageSizeTrials trials;
    SlotPool pool(4096, trials);
    std::vector<std::byte*> slots;
    const auto grow_to = [&](std::size_t mib) {
        while (pool.bytes() < mib << 20)
            slots.push_back(pool.take());
    };
    grow_to(4);
    EXPECT_EQ(trials.next(), Pages::small); // none has been measured
    grow_to(6);
    EXPECT_EQ(trials.next(), Pages::huge); // which is to be tried next
    for (std::byte* slot : slots)
        pool.give_back(slot);
}

TEST(SlotPool, ServesManyThreads) {
    SlotPool pool(10'000);
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&pool, t] {
            for (int round = 0; round < 50; ++round) {
                std::vector<std::byte*> slots(200); // all threads together: some blocks
                for (std::byte*& slot : slots) {
                    slot = pool.take();
                    std::memset(slot, t, 10'000);
                }
                for (std::byte* slot : slots) {
                    EXPECT_EQ(slot[9'999], static_cast<std::byte>(t));
                    pool.give_back(slot);
                }
            }
        });
    threads.clear();
    EXPECT_EQ(pool.bytes(), std::size_t{2} << 20);
}

} // namespace
} // namespace isochron::index
