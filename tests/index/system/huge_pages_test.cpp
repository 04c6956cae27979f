// Pages that are fetched: which, and that their contents stay.
#include "index/system/huge_pages.h"

#include <gtest/gtest.h>

#include <sys/mman.h>

#include <algorithm>

namespace isochron::index {
namespace {

constexpr std::size_t kPage = 4096, kMapped = 64 * kPage;

TEST(FetchedPages, AreThereWithWhatTheyHeldAndNoOthers) {
    auto* const memory = static_cast<std::byte*>(
        ::mmap(nullptr, kMapped, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    ASSERT_NE(static_cast<void*>(memory), MAP_FAILED);
    ::madvise(memory, kMapped, MADV_NOHUGEPAGE);
    const std::span<std::byte> all(memory, kMapped);
    const auto part = all.subspan(100, 10 * kPage); // ends within the eleventh
    all[50] = std::byte{7};
    EXPECT_FALSE(last_page_is_there(part));
    fetch_pages(part);
    fetch_pages(all.first(0));
#ifdef MADV_POPULATE_WRITE
    if (::madvise(memory, kPage, MADV_POPULATE_WRITE) == 0) { // this system can
        EXPECT_TRUE(last_page_is_there(part));
    }
#endif
    EXPECT_TRUE(last_page_is_there(all.first(100)));
    EXPECT_FALSE(last_page_is_there(all));
    EXPECT_EQ(all[50], std::byte{7});
    EXPECT_EQ(std::ranges::count(all, std::byte{0}), static_cast<std::ptrdiff_t>(kMapped) - 1);
    ::munmap(memory, kMapped);
}

} // namespace
} // namespace isochron::index
