// The drawer of curves: what it shows, what presses lead to, and where curves cross a level.
#include "app/panel/parts/curve_drawer.h"

#include "app/panel/parts/curve_plot.h"
#include "app/scene/ticks.h"
#include "index/measure/measures.h"
#include "tests/app/panel/layer_fixture.h"
#include "tests/support/indexed.h"
#include "tests/support/test_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace isochron::app {
namespace {

constexpr std::size_t kSteps = 20;

class CurveDrawerTest : public LayerTest {
  protected:
    CurveDrawerTest() {
        info_.times.resize(kSteps);
        std::iota(info_.times.begin(), info_.times.end(), 0.0);
        info_.length_unit = "mm";
        const index::TestField field({5, 5, 5}, kSteps, index::ValueType::f32,
                                     [](double x, double, double, double t) { return x + t; });
        file_ = index::indexed(folder_, field.view());
        asked_.curves.shown = true;
        asked_.isosurfaces[0].isovalue = 12;
        StepCurve area({.array = file_, .isovalue = 12}, index::measures().size(), kSteps);
        StepCurve mark({.array = file_, .place = glm::dvec3(1)}, 1, kSteps);
        for (std::uint32_t step = 0; step < kSteps; ++step) {
            std::vector<double> numbers(index::measures().size());
            for (std::size_t i = 0; i < numbers.size(); ++i)
                numbers[i] = 1000.0 * static_cast<double>(i) + step;
            area.set(step, numbers);
            mark.set(step, {step + 0.5});
        }
        curves_.surfaces = {std::make_shared<const StepCurve>(area)};
        curves_.mark = std::make_shared<const StepCurve>(mark);
    }
    bool says(const std::string& words) {
        for (int i = 0; i < 3; ++i)
            frame();
        return place_of_text(*ImGui::GetDrawData(), *ImGui::GetIO().Fonts->Fonts.front(), words)
            .has_value();
    }
    /// A place in the plot, as shares of the drawer's width and height.
    glm::vec2 in_drawer(float x, float y) {
        frame();
        const PanelBox& box = layer_.layout().curves;
        return box.low + box.size() * glm::vec2(x, y);
    }

    test_support::TestFolder folder_;
    std::shared_ptr<const index::IndexFile> file_;
};

TEST_F(CurveDrawerTest, ShowsTheNumbersOfThePresentStep) {
    asked_.instant = index::Instant(7);
    EXPECT_TRUE(says("1007 mm^2"));
    EXPECT_TRUE(says("2007 mm^3"));
    EXPECT_TRUE(says("border edges"));
    EXPECT_FALSE(says("greatest")) << "there is no array on the surface";
    EXPECT_FALSE(says("mark to surface"));
    asked_.mark.point.emplace();
    EXPECT_TRUE(says("mark to surface")) << "a distance";
}

TEST_F(CurveDrawerTest, OpensFromTheLineOfTheMark) {
    asked_.curves = {};
    asked_.mark.point.emplace();
    const interaction::Commands commands = click_word("over time");
    ASSERT_TRUE(commands.curves);
    EXPECT_TRUE(commands.curves->shown);
    EXPECT_EQ(commands.curves->measure, kMarkCurve);
    asked_.curves = *commands.curves;
    EXPECT_EQ(click_word("over time").curves->shown, false) << "and closes them again";
}

TEST_F(CurveDrawerTest, PlotsTheValuesAlongTheRulerAndMarksWhereItIsPressed) {
    asked_.curves.measure = kProfileCurve;
    asked_.rulers.list = {{.name = "1", .places = {{0, 1, 1}, {4, 1, 1}}}};
    asked_.isosurfaces[0].isovalue = 3;
    curves_.profile = std::make_shared<const index::Profile>(
        index::profile_of({file_, index::Instant(1), asked_.rulers.list[0].places}));
    EXPECT_TRUE(says("ruler 1, 4 mm, 1"));
    EXPECT_TRUE(says("at 2 mm rising"));
    const interaction::Commands pressed = click(in_drawer(0.4f, 0.5f));
    ASSERT_TRUE(pressed.mark && pressed.mark->point);
    const interaction::MarkedPoint& point = *pressed.mark->point;
    EXPECT_NEAR(point.value, point.position.x + 1, 1e-6);
    EXPECT_TRUE(point.position.x > 0.5 && point.position.x < 3.5) << point.position.x;
    EXPECT_FALSE(pressed.instant) << "the ruler is no axis of time";
}

TEST_F(CurveDrawerTest, HasTwoNumbersOnItsAxisHoweverLowItIs) {
    info_.length_unit.clear();
    size_ = {636, 360};
    for (const double apart : {0.0234, 17.0}) {
        StepCurve area({.array = file_, .isovalue = 12}, index::measures().size(), kSteps);
        for (std::uint32_t step = 0; step < kSteps; ++step)
            area.set(step, std::vector<double>(index::measures().size(),
                                               18.7 * apart + apart * step / (kSteps - 1)));
        curves_.surfaces = {std::make_shared<const StepCurve>(area)};
        for (int i = 0; i < 3; ++i)
            frame();
        std::ptrdiff_t numbers = 0;
        for (const int most : {2, 3, 4, 6}) {
            const Ticks ticks = nice_ticks(18.64 * apart, 19.76 * apart, most);
            numbers = std::max(numbers, std::ranges::count_if(ticks.values, [&](double value) {
                                   return place_of_text(*ImGui::GetDrawData(),
                                                        *ImGui::GetIO().Fonts->Fonts.front(),
                                                        tick_text(value, ticks.step))
                                       .has_value();
                               }));
        }
        EXPECT_GE(numbers, 2) << apart;
    }
}

TEST_F(CurveDrawerTest, GoesWhereThePlotIsPressed) {
    const interaction::Commands early = click(in_drawer(0.2f, 0.5f));
    const interaction::Commands late = click(in_drawer(0.6f, 0.5f));
    ASSERT_TRUE(early.instant && late.instant);
    EXPECT_LT(early.instant->step, late.instant->step);
    EXPECT_EQ(early.instant->fraction, 0u);
}

TEST_F(CurveDrawerTest, PlotsTheMeasureWhoseLineIsPressed) {
    const interaction::Commands commands = click_word("bodies");
    ASSERT_TRUE(commands.curves);
    EXPECT_EQ(commands.curves->measure, "bodies");
    EXPECT_TRUE(commands.curves->shown);
}

TEST_F(CurveDrawerTest, ListsWhenTheValueAtTheMarkCrossesTheIsovalue) {
    asked_.curves.measure = kMarkCurve;
    const interaction::Commands commands = click_word("11.5 rising");
    ASSERT_TRUE(commands.instant);
    EXPECT_EQ(*commands.instant, index::Instant(11)) << "11.5 is below 12, the next one above";
}

TEST_F(CurveDrawerTest, ClosesByItsKeyAndIsOpenInOldMeasures) {
    asked_.curves.measure = "of a later version";
    EXPECT_TRUE(says("1000 mm^2")) << "what it does not know is the area";
    EXPECT_GT(layer_.layout().curves.size().y, 100.0f);
    asked_.curves.shown = false;
    frame();
    EXPECT_EQ(layer_.layout().curves.size().y, 0.0f);
}

TEST_F(CurveDrawerTest, IsLaidOutInWindowsOfAnySizeAndWithoutNumbers) {
    curves_ = {};
    for (const glm::ivec2 size : {glm::ivec2(300, 240), glm::ivec2(640, 480), kSize}) {
        size_ = size;
        for (const bool logarithmic : {false, true}) {
            asked_.curves.logarithmic = logarithmic;
            EXPECT_TRUE(says("lin") || says("log"));
        }
    }
}

TEST(Crossings, LieWhereTheLineBetweenTwoStepsMeetsTheLevel) {
    const double nan = std::nan("");
    const std::array values{0.0, 2.0, 4.0, 4.0, 1.0, nan, 9.0, 3.0, 3.0};
    const auto found = crossings_of(values, 3.0);
    ASSERT_EQ(found.size(), 2u) << "a value at the level is above it";
    EXPECT_EQ(found[0].step, 1u);
    EXPECT_DOUBLE_EQ(found[0].share, 0.5);
    EXPECT_TRUE(found[0].rises);
    EXPECT_EQ(found[1].step, 3u);
    EXPECT_DOUBLE_EQ(found[1].share, 1.0 / 3);
    EXPECT_FALSE(found[1].rises);
    const auto touching = crossings_of(std::array{1.0, 3.0, 1.0}, 3.0);
    ASSERT_EQ(touching.size(), 2u);
    EXPECT_EQ(touching[0].step, 1u) << "reached at that step";
    EXPECT_EQ(touching[0].share, 0.0);
    EXPECT_EQ(touching[1].step, 1u);
}

} // namespace
} // namespace isochron::app
