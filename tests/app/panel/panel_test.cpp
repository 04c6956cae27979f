// The panel without a window: whatever the data are called and hold, it can be laid out.
#include "app/config/config.h"
#include "app/panel/panel.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <cmath>
#include <limits>

namespace isochron::app {
namespace {

class PanelTest : public testing::Test {
  protected:
    PanelTest() : imgui_(ImGui::CreateContext()) {
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {640, 480};
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
        info_.times = {0, 1};
        stats_.histogram.assign(256, 1);
    }
    ~PanelTest() override { ImGui::DestroyContext(imgui_); }

    /// Three frames with the mouse at a place, pressed in the last: a window is there once laid
    /// out.
    interaction::Commands press(float x, float y) {
        interaction::Commands commands;
        for (const bool down : {false, false, true}) {
            ImGui::GetIO().MousePos = {x, y};
            ImGui::GetIO().MouseDown[0] = down;
            ImGui::NewFrame();
            PanelArea area;
            PanelPages pages;
            commands = draw_panel({.info = info_,
                                   .stats = stats_,
                                   .asked = asked_,
                                   .frame = frame_,
                                   .frame_times = {},
                                   .failure = {},
                                   .message = {},
                                   .controls = controls_,
                                   .at_hand = {}},
                                  area, pages);
            ImGui::Render();
        }
        return commands;
    }

    /// Presses on the first control from the top, the histogram, in the middle of the panel.
    interaction::Commands press_on_histogram() { return press(144.0f, 62.0f); }

    ImGuiContext* imgui_;
    index::SeriesInfo info_;
    index::IndexStats stats_;
    ExplorerState asked_;
    FrameReport frame_;
    std::vector<interaction::ControlGroup> controls_{
        {interaction::DeviceKind::hands, {"Up Down   isovalue by 100 % of %s"}}};
};

TEST_F(PanelTest, TakesUnitsAsTextAndNotAsFormats) {
    stats_.low = 0;
    stats_.high = 100;
    for (const char* unit : {"%", "% signal change", "%s", "%n", "%%", "%5.1f%", "mm\xc2\xb2 s%"}) {
        info_.value_unit = info_.time_unit = info_.length_unit = info_.array = unit;
        const auto commands = press_on_histogram();
        ASSERT_TRUE(commands.isovalue.has_value()) << unit;
        EXPECT_NEAR(*commands.isovalue, 50, 5) << unit;
    }
}

TEST_F(PanelTest, TakesValuesUpToTheGreatestOfADouble) {
    constexpr double kMost = std::numeric_limits<double>::max();
    const double ranges[][2]{{-kMost, kMost}, {0, kMost},  {kMost, kMost},
                             {-kMost, 0},     {0, 5e-324}, {0, 0}};
    for (const auto& [low, high] : ranges) {
        stats_.low = low;
        stats_.high = high;
        const double first = quantile(stats_, kFirstQuantile);
        EXPECT_TRUE(low <= first && first <= high) << low << " to " << high;
        asked_.set_isovalue(first);
        const auto commands = press_on_histogram();
        EXPECT_EQ(commands.isovalue.has_value(), high / 2 > low / 2);
        EXPECT_TRUE(!commands.isovalue ||
                    (low <= *commands.isovalue && *commands.isovalue <= high));
    }
}

} // namespace
} // namespace isochron::app
