// File names of pictures: unchanged for one window, different for several.
#include "app/output/picture_names.h"

#include "tests/support/test_folder.h"

#include <gtest/gtest.h>

namespace isochron::app {
namespace {

TEST(PictureNames, OneWindowWithOneViewportAddsNothing) {
    const PictureNames names = picture_names({});
    ASSERT_EQ(names.windows.size(), 1u);
    EXPECT_EQ(names.windows[0].suffix, "");
    EXPECT_EQ(names.windows[0].viewports, std::vector<std::string>{""});
}

TEST(PictureNames, SeveralWindowsAndViewportsAreTold) {
    stereo::Installation lab;
    lab.windows.resize(2);
    lab.windows[0].name = "front";
    lab.windows[1].name = "left";
    lab.windows[1].viewports.resize(2);
    lab.windows[1].viewports[0].name = "upper half";
    const PictureNames names = picture_names(lab);
    EXPECT_EQ(names.windows[0].suffix, "_front");
    EXPECT_EQ(names.windows[0].viewports, std::vector<std::string>{"_front"});
    EXPECT_EQ(names.windows[1].suffix, "_left");
    EXPECT_EQ(names.windows[1].viewports,
              (std::vector<std::string>{"_left_upper_half", "_left_viewport2"}));
}

TEST(PictureNames, NamesThatLookAlikeAsFilesStillDiffer) {
    stereo::Installation lab;
    lab.windows.resize(3);
    lab.windows[0].name = "a b";
    lab.windows[1].name = "a/b";
    lab.windows[2].name = "a_b";
    const PictureNames names = picture_names(lab);
    EXPECT_EQ(names.windows[0].suffix, "_a_b");
    EXPECT_EQ(names.windows[1].suffix, "_a_b_2");
    EXPECT_EQ(names.windows[2].suffix, "_a_b_3");
}

TEST(PictureNames, ScreenshotsAreCountedOnFromThoseThatAreThere) {
    const test_support::TestFolder folder;
    EXPECT_EQ(last_screenshot(folder.path() / "missing"), 0);
    EXPECT_EQ(last_screenshot(folder.path()), 0);
    folder.write("isochron_0007_front.png", "");
    folder.write("isochron_0003.png", "");
    folder.write("isochron_notes.txt", "");
    EXPECT_EQ(last_screenshot(folder.path()), 7);
    folder.write(screenshot_name(12345) + ".png", "");
    EXPECT_EQ(last_screenshot(folder.path()), 12345);
}

} // namespace
} // namespace isochron::app
