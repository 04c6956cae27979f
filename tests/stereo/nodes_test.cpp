// The windows that each process of a job opens.
#include "stereo/nodes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace isochron::stereo {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Installation with_nodes(const std::vector<int>& nodes) {
    Installation installation;
    installation.windows.clear();
    for (const int node : nodes) {
        Window& window = installation.windows.emplace_back();
        window.name = "window " + std::to_string(installation.windows.size());
        window.node = node;
    }
    return installation;
}

TEST(Nodes, EveryWindowIsOpenedByExactlyOneProcessWhateverTheirNumber) {
    const Installation installation = with_nodes({1, 2, 3, 4, 4, 0});
    for (int ranks = 1; ranks <= 5; ++ranks) {
        std::vector<int> opened(installation.windows.size());
        for (int rank = 0; rank < ranks; ++rank) {
            const auto numbers = windows_of(installation, rank, ranks);
            EXPECT_FALSE(numbers.empty()) << rank << " of " << ranks;
            for (const std::size_t number : numbers)
                ++opened[number];
        }
        EXPECT_THAT(opened, testing::Each(1)) << ranks;
    }
}

TEST(Nodes, AProcessForEachNodeOpensItsWindowsAndFewerShareNeighbors) {
    const Installation cave = with_nodes({1, 2, 3, 4});
    EXPECT_EQ(node_count(cave), 5);
    EXPECT_THAT(windows_of(cave, 0, 5), IsEmpty());
    EXPECT_THAT(windows_of(cave, 3, 5), ElementsAre(2));
    EXPECT_THAT(windows_of(cave, 0, 2), ElementsAre(0, 1)) << "nodes 0, 1 and 2";
    EXPECT_THAT(windows_of(cave, 1, 2), ElementsAre(2, 3)) << "nodes 3 and 4";
    EXPECT_THAT(windows_of(cave, 0, 1), ElementsAre(0, 1, 2, 3));
}

TEST(Nodes, TheFirstProcessGetsTheOperatorsWindowWhereItHasNoWall) {
    Installation cave = with_nodes({1, 2, 3, 4});
    cave.windows[2].name = "console";
    add_console(cave, 2);
    EXPECT_EQ(cave.windows.size(), 4u) << "it has walls";
    add_console(cave, 5);
    ASSERT_EQ(cave.windows.size(), 5u);
    EXPECT_EQ(cave.windows.back().name, "console'") << "no two windows share a name";
    EXPECT_TRUE(cave.windows.back().viewports.front().screen.carried_by_head);
    EXPECT_THAT(windows_of(cave, 0, 5), ElementsAre(4));
}

TEST(Nodes, AJobThatCannotShowTheInstallationIsToldWhy) {
    EXPECT_EQ(misfit(with_nodes({1, 2}), 3), "");
    EXPECT_EQ(misfit(with_nodes({1, 2}), 1), "");
    EXPECT_EQ(misfit(with_nodes({0}), 2),
              "2 processes for 1 node: start as many as windows name nodes, or fewer");
    EXPECT_EQ(misfit(with_nodes({0, 2}), 1), "no window is on node 1 of 3");
}

TEST(Nodes, FullscreenWindowsOfAProcessCoverMonitorsThatNoOtherOfThemCovers) {
    Installation installation = with_nodes({0, 0, 1, 0, 1});
    for (Window& window : installation.windows)
        window.fullscreen = true;
    installation.windows[1].monitor = 0;
    EXPECT_THAT(monitors_of(installation, {0, 1, 3}), ElementsAre(1, 0, 2));
    EXPECT_THAT(monitors_of(installation, {2, 4}), ElementsAre(0, 1));
    installation.windows[4].fullscreen = false;
    EXPECT_THAT(monitors_of(installation, {4, 2}), ElementsAre(kNextMonitor, 0));
}

} // namespace
} // namespace isochron::stereo
