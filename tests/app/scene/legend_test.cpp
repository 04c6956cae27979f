// The legend fits into the picture, and its colors and numbers belong together.
#include "app/scene/font.h"
#include "app/scene/legend.h"
#include "app/scene/orientation.h"
#include "app/scene/ticks.h"

#include "index/surface/cell_colors.h"
#include "render/gl/srgb.h"
#include "stereo/screen.h"
#include "tests/support/drawing/gl_test.h"

#include <cmath>

namespace isochron::app {
namespace {

using render::ScreenQuad;

class LegendTest : public render::GlTest {
  protected:
    Legend of_temperature() const {
        return {.surfaces = {},
                .value_unit = "K",
                .scales = {{.title = "temperature [K]", .range = {280, 320}, .whole = {250, 400}}},
                .colored = true};
    }
    render::TextPass text_{gl_, room_font};
};

TEST_P(LegendTest, LiesWithinThePictureOrIsLeftOut) {
    for (const glm::ivec2 size : {glm::ivec2(1920, 1080), {700, 700}, {400, 300}, {120, 90}}) {
        const auto quads = legend_quads(of_temperature(), text_, size);
        EXPECT_EQ(quads.empty(), size.x < 200) << size.x;
        for (const ScreenQuad& quad : quads) {
            EXPECT_GE(quad.at.x + quad.low.x, 0);
            EXPECT_GE(quad.at.y + quad.low.y, 0);
            EXPECT_LE(quad.at.x + quad.high.x, size.x);
            EXPECT_LE(quad.at.y + quad.high.y, size.y);
        }
    }
}

TEST_P(LegendTest, ShowsTheMapFromLowToHigh) {
    const auto quads = legend_quads(of_temperature(), text_, {1000, 1000});
    const auto colors = render::color_map(render::ColorMap::viridis);
    const auto has = [&](const glm::vec3& light) {
        const glm::vec3 color = render::srgb_from_linear(light);
        return std::ranges::find_if(quads, [&](const ScreenQuad& quad) {
            return glm::length(glm::vec3(quad.color) - color) < 1e-4f;
        });
    };
    const auto low = has(colors.front()), high = has(colors.back());
    ASSERT_TRUE(low != quads.end() && high != quads.end());
    EXPECT_LT(low->low.y, high->low.y);
    EXPECT_EQ(low->low.x, high->low.x);
}

TEST_P(LegendTest, HasNoBoxOnAnyBackgroundButHalosOfItsColor) {
    Legend legend = of_temperature();
    for (const std::string_view name : interaction::kNames<interaction::Background>) {
        const auto background = *interaction::value_named<interaction::Background>(name);
        legend.overlay = overlay_colors_on(background);
        const auto quads = legend_quads(legend, text_, {1000, 1000});
        const auto has = [&](const auto& is_it) { return std::ranges::any_of(quads, is_it); };
        const float widest = 2.5f * text_height({1000, 1000}); // the bar of colors with its rim
        EXPECT_FALSE(has([&](const ScreenQuad& quad) { return quad.high.x - quad.low.x > widest; }))
            << "a box";
        EXPECT_TRUE(has([&](const ScreenQuad& quad) {
            return static_cast<int>(quad.letters) % 2 == 1 && quad.color == legend.overlay.halo();
        }));
        EXPECT_TRUE(has([&](const ScreenQuad& quad) {
            return quad.letters > 0 && quad.color == legend.overlay.text;
        }));
    }
}

TEST_P(LegendTest, IsNotNeededForOneSurfaceAndListsSeveral) {
    const std::vector<interaction::Isosurface> one(1), two{{1, {1, 0, 0}, 1}, {2, {0, 1, 0}, 1}};
    EXPECT_TRUE(
        legend_quads({.surfaces = one, .value_unit = "K", .scales = {}}, text_, {1000, 1000})
            .empty());
    const auto quads =
        legend_quads({.surfaces = two, .value_unit = "K", .scales = {}}, text_, {1000, 1000});
    for (const auto& surface : two)
        EXPECT_TRUE(std::ranges::any_of(
            quads, [&](const ScreenQuad& quad) { return glm::vec3(quad.color) == surface.color; }));
    auto hidden = two;
    hidden.back().opacity = 0;
    EXPECT_TRUE(
        legend_quads({.surfaces = hidden, .value_unit = "K", .scales = {}}, text_, {1000, 1000})
            .empty());
}

TEST_P(LegendTest, HasShorterBarsWhereSomethingLiesAbove) {
    const Legend legend = of_temperature();
    const glm::ivec2 picture(600, 272);
    const auto top_of = [&](float highest) {
        float top = 0;
        for (const ScreenQuad& quad : legend_quads(legend, text_, picture, 15.0f / 272, highest))
            top = std::max(top, quad.at.y + quad.high.y);
        return top;
    };
    const float whole = top_of(0);
    EXPECT_GT(whole, 180);
    EXPECT_EQ(top_of(260), whole) << "it has room";
    for (const float highest : {174.0f, 150.0f, 120.0f}) {
        EXPECT_LE(top_of(highest), highest);
        EXPECT_GT(top_of(highest), highest - 30);
    }
    EXPECT_GT(top_of(20), 80) << "no bar is shorter than its numbers";
}

TEST_P(LegendTest, AxesInTheOtherCornerEndBelowWhatLiesAboveThem) {
    stereo::Screen screen;
    screen.lower_left = {-0.5f, -0.1f, -1.2f};
    screen.upper_left = {-0.5f, 0.1f, -1.2f};
    screen.upper_right = {0.5f, 0.1f, -1.2f};
    screen.carried_by_head = true;
    const render::View view = stereo::view_of(screen, {{0, 1.6f, 0}, {1, 0, 0, 0}},
                                              stereo::Eye::center, 0, 0.05f, 50, {600, 136});
    const interaction::Similarity ahead{{0, 1.6, -2}, {1, 0, 0, 0}, 0.1};
    index::SeriesInfo info;
    info.grid.vertices = {9, 9, 9};
    for (const float highest : {0.0f, 120.0f, 98.0f, 66.0f, 50.0f}) {
        const Orientation shown =
            orientation_in(view, ahead, info, text_, {}, 15.0f / 136, highest);
        EXPECT_EQ(shown.lines.empty(), highest == 50) << highest;
        float top = 0;
        for (const ScreenQuad& quad : shown.quads)
            top = std::max(top, quad.at.y + quad.high.y);
        EXPECT_GT(top, 20) << "the scale bar stays";
        if (highest > 0)
            EXPECT_LE(top, highest);
        else
            EXPECT_GT(top, 98);
    }
}

TEST_P(LegendTest, ListsGhostsByTimeAlsoOfOneSurface) {
    const std::vector<interaction::Isosurface> one(1);
    Legend legend{.surfaces = one, .value_unit = "K", .scales = {}};
    legend.ghosts = {{glm::vec3(0, 0, 1), "step 3, earlier"},
                     {glm::vec3(1, 0.5f, 0), "step 9, later"}};
    const auto quads = legend_quads(legend, text_, {640, 480});
    const auto patch = [&](const glm::vec3& color) {
        return std::ranges::find_if(
            quads, [&](const ScreenQuad& quad) { return glm::vec3(quad.color) == color; });
    };
    const auto earlier = patch(*legend.ghosts[0].color), later = patch(*legend.ghosts[1].color);
    ASSERT_TRUE(earlier != quads.end() && later != quads.end());
    EXPECT_LT(earlier->high.y, later->low.y);
    EXPECT_EQ(earlier->low.x, later->low.x);
}

TEST_P(LegendTest, SaysWhichArrayTheIsovaluesAreOfWhereColorsAreAnothers) {
    const std::vector<interaction::Isosurface> two{{1, {1, 0, 0}, 1}, {2, {0, 1, 0}, 1}};
    Legend legend = of_temperature();
    legend.surfaces = two;
    const auto without = legend_quads(legend, text_, {1000, 1000});
    legend.array = "pressure";
    const auto with = legend_quads(legend, text_, {1000, 1000});
    // Each letter has its halo below it.
    EXPECT_EQ(with.size() - without.size(), 2 * legend.array.size());
    legend.scales.clear(); // patches of color tell then
    legend.colored = false;
    EXPECT_EQ(legend_quads(legend, text_, {1000, 1000}).size(),
              legend_quads({.surfaces = two, .value_unit = "K", .scales = {}}, text_, {1000, 1000})
                  .size());
}

TEST_P(LegendTest, NamesTheArrayOfEachSurfaceWhereSeveralArraysHaveSome) {
    const std::vector<interaction::Isosurface> one{{292.5, {1, 0, 0}, 1}};
    Legend legend{.surfaces = one, .value_unit = "K", .scales = {}};
    legend.array = "heat";
    legend.further = {{glm::vec3(0, 0, 1), "wind 7.7 m/s"}};
    // Letters and their halos, a patch and its rim in each of two lines.
    EXPECT_EQ(legend_quads(legend, text_, {640, 480}).size(),
              2 * std::string("heat 292.5 Kwind 7.7 m/s").size() + 4);
    legend.scales = of_temperature().scales;
    legend.colored = true; // without the patch, and no line with the array alone
    const auto scaled = legend_quads(legend, text_, {1000, 1000}).size();
    legend.further.clear();
    legend.surfaces = {};
    legend.array.clear();
    const auto scale = legend_quads(legend, text_, {1000, 1000}).size();
    EXPECT_EQ(scaled - scale, 2 * std::string("heat 292.5 Kwind 7.7 m/s").size() + 2);
}

TEST(ColorScales, GoByLogarithmsWhereValuesAreAboveZero) {
    ColorScale scale{.title = "", .range = {0.1, 1000.0}, .whole = {0.0, 1000.0}};
    EXPECT_NEAR(share_on(scale, 500.05), 0.5, 1e-9);
    scale.logarithmic = true;
    for (int decade = -1; decade <= 3; ++decade)
        EXPECT_NEAR(share_on(scale, std::pow(10.0, decade)), (decade + 1) / 4.0, 1e-9);
}

TEST(ColorScales, OfOneValueSayIt) {
    const std::vector<ScaleTick> ticks = ticks_on(
        {.title = "", .range = {1.2, 1.2}, .whole = {1.2, 1.2}, .colors = {}, .use = {}}, 6);
    ASSERT_EQ(ticks.size(), 1u);
    EXPECT_EQ(ticks.front().words, "1.2");
    EXPECT_EQ(ticks.front().share, 0.0) << "where a map has the color of the only value";
}

TEST(ColorScales, SharesOfWhatIsShownMakeARange) {
    index::Extraction shown;
    const auto in_shares = [&](const std::array<double, 2>& whole) {
        return range_of_shares({std::make_shared<index::Extraction>(shown)}, whole, {0.02, 0.98});
    };
    EXPECT_FALSE(in_shares({0, 1}));
    for (std::uint16_t i = 0; i <= 1000; ++i) // a tenth of the range, and one far out
        shown.colors.push_back(i == 1000 ? 8190 : static_cast<std::uint16_t>(819 * i / 1000));
    shown.colors.insert(shown.colors.end(), 500, index::kNoColor);
    const auto range = in_shares({100, 200});
    ASSERT_TRUE(range);
    EXPECT_NEAR((*range)[0], 100.2, 0.05);
    EXPECT_NEAR((*range)[1], 109.8, 0.05);
    // The range for a set is sorted out once, and anew for another set or other percentiles.
    PercentileRange cached;
    const auto set = std::make_shared<index::Extraction>(shown);
    EXPECT_EQ(cached.of({set}, {100, 200}, {2, 98}), range);
    EXPECT_EQ(cached.of({set}, {100, 200}, {2, 98}), range);
    EXPECT_NEAR(cached.of({set}, {100, 200}, {50, 98}).value()[0], 105, 0.05);
    EXPECT_NEAR(cached.of({set}, {0, 100}, {50, 98}).value()[0], 5, 0.05);
    EXPECT_FALSE(cached.of({}, {0, 100}, {50, 98}));
    // Beside it as many vertices of a further surface, all at the upper end.
    index::CellMesh mesh;
    mesh.colors.assign(1001, index::kFineColorSteps);
    mesh.colors.insert(mesh.colors.end(), 70, index::kNoFineColor);
    const auto further = std::make_shared<index::InstantSurfaces>();
    further->meshes = {nullptr, std::make_shared<const index::CellMesh>(mesh)};
    const auto wider = cached.of({set, {further}}, {100, 200}, {2, 98});
    ASSERT_TRUE(wider);
    EXPECT_NEAR((*wider)[0], 100.4, 0.05);
    EXPECT_EQ((*wider)[1], 200);
    shown.colors.assign(10, 77);
    EXPECT_FALSE(cached.of({std::make_shared<index::Extraction>(shown)}, {0, 100}, {50, 98}));
    EXPECT_FALSE(in_shares({0, 1})) << "one value alone";
}

TEST(Ticks, OfLogarithmsArePowersOfTenOrPartsOfThem) {
    EXPECT_EQ(logarithmic_ticks(0.1, 1000, 6).values, (std::vector<double>{0.1, 1, 10, 100, 1000}));
    EXPECT_EQ(logarithmic_ticks(1, 10, 6).values, (std::vector<double>{1, 2, 5, 10}));
    EXPECT_EQ(logarithmic_ticks(1e-6, 1e6, 6).values.size(), 5u); // every third
    EXPECT_GE(logarithmic_ticks(3, 4, 6).values.size(), 2u);
    EXPECT_TRUE(logarithmic_ticks(0, 4, 6).values.empty());
}

INSTANTIATE_TEST_SUITE_P(, LegendTest, render::both_contexts(), render::context_name);

TEST(RoomFont, HasWhatUnitsNeed) {
    const render::GlyphAtlas atlas = room_font(32);
    for (const char32_t character : std::u32string(U"0123456789.-+e[]µ°²³Ωm"))
        EXPECT_TRUE(atlas.find(character)) << static_cast<unsigned>(character);
    EXPECT_GT(render::text_width(atlas, "mm"), render::text_width(atlas, "ii"));
}

} // namespace
} // namespace isochron::app
