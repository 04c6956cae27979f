// What the panel says of cells: always those of the volume itself, or that they are not counted.
#include "app/panel/panel_statistics.h"

#include <gtest/gtest.h>

namespace isochron::app {
namespace {

TEST(PanelStatistics, CountsAreThoseOfLevelZeroOrAreSaidToBeUnknown) {
    FrameReport frame;
    frame.cells = 1234;
    EXPECT_EQ(words_for_cells(frame), "1234 cells");
    frame.finest = 1;
    frame.coarsest = 3;
    EXPECT_EQ(words_for_cells(frame), "cells not counted yet (1234 drawn, of levels 1 to 3)");
    frame.volume_cells = 98765;
    EXPECT_EQ(words_for_cells(frame), "98765 cells (1234 drawn, of levels 1 to 3)");
}

} // namespace
} // namespace isochron::app
