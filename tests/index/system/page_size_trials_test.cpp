// Which kind of pages is faster: found by trying both, and anew when times change.
#include "index/system/page_size_trials.h"

#include <gtest/gtest.h>

#include <array>

namespace isochron::index {
namespace {

using namespace std::chrono_literals;

/// Takes blocks from a machine with these times. @return how many had each kind of pages
std::array<unsigned, 2> taken(PageSizeTrials& trials, unsigned blocks,
                              std::chrono::nanoseconds small, std::chrono::nanoseconds huge) {
    std::array<unsigned, 2> counts{};
    for (unsigned i = 0; i < blocks; ++i) {
        const Pages pages = trials.next();
        ++counts[static_cast<std::size_t>(pages)];
        trials.took(pages, pages == Pages::small ? small : huge);
    }
    return counts;
}

TEST(PageSizeTrials, TriesEachKindOnceAndThenTakesTheFasterOne) {
    PageSizeTrials huge_is_faster, small_is_faster;
    EXPECT_EQ(taken(huge_is_faster, 30, 400us, 60us), (std::array{1u, 29u}));
    EXPECT_EQ(taken(small_is_faster, 30, 400us, 5ms), (std::array{29u, 1u}));
}

TEST(PageSizeTrials, TriesTheSlowerOneLessAndLess) {
    PageSizeTrials trials;
    const unsigned first = PageSizeTrials::kBetweenTrials;
    EXPECT_EQ(taken(trials, first + 2, 400us, 5ms)[1], 2u);
    EXPECT_EQ(taken(trials, 2 * first - 1, 400us, 5ms)[1], 0u);
    EXPECT_EQ(taken(trials, 1, 400us, 5ms)[1], 1u);
    EXPECT_LE(taken(trials, 1000 * first, 400us, 5ms)[1], 10u);
}

TEST(PageSizeTrials, FollowsTimesThatChange) {
    PageSizeTrials trials;
    taken(trials, 10, 400us, 60us);
    // Huge pages have become slow: the next block shows it.
    EXPECT_LE(taken(trials, 30, 400us, 5ms)[1], 2u);
    // They are fast again, which a trial shows.
    EXPECT_GE(taken(trials, 3 * PageSizeTrials::kBetweenTrials, 400us, 60us)[1],
              PageSizeTrials::kBetweenTrials);
}

TEST(PageSizeTrials, OneSlowBlockAmongFastOnesIsForgotten) {
    PageSizeTrials trials;
    taken(trials, 10, 400us, 60us);
    trials.took(Pages::huge, 600us); // (60 + 600) / 2 is less than 400
    EXPECT_EQ(trials.next(), Pages::huge);
}

} // namespace
} // namespace isochron::index
