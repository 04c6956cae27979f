// The warnings about processes on one machine that have too few processors to draw.
#include "app/cluster/processor_shares.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace isochron::app {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> told(const std::vector<ProcessorShare>& shares) {
    return shared_processors(shares);
}

TEST(ProcessorShares, AreSaidWhereMoreThreadsDrawThanThereAreProcessors) {
    const ProcessorShare all{"wall", {0, 1, 2, 3}, 4};
    EXPECT_THAT(told({all, all}),
                ElementsAre("2 processes draw in software on wall, 8 threads on 4 processors: "
                            "mpirun --bind-to none -x LP_NUM_THREADS=2 gives each its own"));
    const ProcessorShare one{"wall", {0, 1}, 1};
    EXPECT_THAT(told({one, one, one}),
                ElementsAre("3 processes draw in software on wall, 3 threads on 2 processors: "
                            "start no more than 2 there"));
}

TEST(ProcessorShares, AreFineOnOtherMachinesWithOtherProcessorsOrWithAGpu) {
    EXPECT_THAT(told({{"left", {0, 1}, 2}, {"right", {0, 1}, 2}}), IsEmpty());
    EXPECT_THAT(told({{"wall", {0, 1}, 2}, {"wall", {2, 3}, 2}}), IsEmpty());
    EXPECT_THAT(told({{"wall", {0, 1}, 2}, {"wall", {0, 1}, 0}}), IsEmpty());
    EXPECT_THAT(told({{"wall", {0}, 4}}), IsEmpty()) << "one process is its own affair";
    EXPECT_THAT(told({}), IsEmpty());
}

} // namespace
} // namespace isochron::app
