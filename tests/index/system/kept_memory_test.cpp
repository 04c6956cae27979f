// Memory of large vectors that is used again.
#include "index/system/kept_memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace isochron::index {
namespace {

constexpr std::size_t kLarge = 3 * kLeastKeptBytes;

class KeptMemory : public testing::Test {
  protected:
    KeptMemory() { free_kept(); }
    ~KeptMemory() override { free_kept(); }
};

TEST_F(KeptMemory, OfAVectorIsThatOfTheNextOneOfNearlyItsSize) {
    const void* first = nullptr;
    {
        const KeptVector<std::uint8_t> vector(kLarge, 7);
        first = vector.data();
    }
    const KeptVector<std::uint8_t> next(kLarge - 100, 8);
    EXPECT_EQ(next.data(), first);
    EXPECT_EQ(std::ranges::count(next, 8), kLarge - 100);
    const KeptVector<std::uint8_t> another(kLarge, 9);
    EXPECT_NE(another.data(), first);
    EXPECT_EQ(std::ranges::count(next, 8), kLarge - 100);
}

TEST_F(KeptMemory, GoesBackToTheSystemOnceIfItIsNotInUse) {
    const KeptVector<std::uint8_t> used(kLarge, 7);
    {
        const KeptVector<std::uint8_t> free(2 * kLarge);
    }
    EXPECT_GE(free_kept(), 2 * kLarge);
    EXPECT_EQ(free_kept(), 0);
    EXPECT_EQ(std::ranges::count(used, 7), kLarge);
}

TEST_F(KeptMemory, IsHalfAGibibyteAtMost) {
    constexpr std::size_t kQuarter = 256 << 20, kCount = 4;
    std::array<void*, kCount> blocks{};
    for (void*& block : blocks)
        block = take_kept(kQuarter); // never touched
    for (void* const block : blocks)
        give_back_kept(block, kQuarter);
    EXPECT_EQ(free_kept(), 2 * kQuarter);
}

TEST_F(KeptMemory, AVectorThatGrowsKeepsItsValues) {
    KeptVector<std::uint32_t> grown;
    for (std::uint32_t i = 0; i < 1u << 20; ++i)
        grown.push_back(i);
    for (std::uint32_t i = 0; i < 1u << 20; ++i)
        ASSERT_EQ(grown[i], i);
}

} // namespace
} // namespace isochron::index
