// Words beside places in the data make room for each other, in both eyes.
#include "app/scene/callouts.h"

#include "app/scene/font.h"
#include "app/scene/legend.h"
#include "app/scene/mark.h"
#include "stereo/context/gl_context.h"
#include "tests/support/test_seed.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace isochron::app {
namespace {

constexpr glm::ivec2 kSize(1280, 960);

std::vector<render::View> both_eyes() {
    std::vector<render::View> views;
    for (const float side : {0.5f, -0.5f})
        views.push_back(
            {.clip_from_eye = glm::perspective(glm::radians(50.0f), 4.0f / 3, 0.05f, 50.0f),
             .eye_from_room = glm::translate(glm::mat4(1.0f), glm::vec3(side * 0.063f, 0, 0)),
             .size = kSize});
    return views;
}

using Box = std::array<float, 4>;

Box box_of(const Callout& callout, const CalloutPaper& paper, const render::View& view,
           float share = 0.0f) {
    const glm::vec4 clip = view.clip_from_eye * view.eye_from_room * glm::vec4(callout.at, 1.0f);
    const glm::vec2 at = (0.5f * glm::vec2(clip) / clip.w + 0.5f) * glm::vec2(view.size);
    const float height = text_height(view.size, share);
    return {at.x + height * paper.low.x, at.y + height * paper.low.y, at.x + height * paper.high.x,
            at.y + height * paper.high.y};
}
bool overlap(const Box& a, const Box& b) {
    return a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
}

Callout mark_at(const glm::vec3& at) {
    return {at, {"9.446 1/s", "3.42, 4.41, 5.60 m", "at 2.908 s"}, {}, CalloutSign::cross};
}
Callout length_at(const glm::vec3& at) {
    return {at, {"1.25 m"}, {}, CalloutSign::none};
}
Callout pointed_at(const glm::vec3& at) {
    return {at, {"9.446 1/s", "3.42, 4.41, 5.60 m"}, {}, CalloutSign::dot};
}

TEST(Callouts, OfAPlaceBetweenStepsSayBetweenWhich) {
    index::SeriesInfo info;
    info.times = {0, 2, 4};
    info.time_unit = "s";
    info.array = "flow";
    info.length_unit = "m";
    const interaction::MarkedPoint at_step{{1, 2, 3}, index::Instant(1), 9.25},
        between{{1, 2, 3}, {1, 32768}, 9.25}, last{{1, 2, 3}, {2, 32768}, 9.25};
    EXPECT_EQ(mark_lines(at_step, info).back(), "t 2 s");
    EXPECT_EQ(mark_lines(between, info).back(), "t 3 s, between steps 2 and 3");
    EXPECT_EQ(mark_text(between, info),
              "x 1.0 y 2.0 z 3.0 m, flow 9.25, t 3 s, between steps 2 and 3");
    EXPECT_EQ(mark_lines(last, info).back(), "t 4 s") << "the last step holds";
    EXPECT_EQ(pointed_lines({at_step, 0}, 1, info).back(), "x 1.0 y 2.0 z 3.0 m");
    EXPECT_EQ(pointed_lines({between, 0}, 1, info).back(), "between steps 2 and 3");
}

TEST(Callouts, OfAGhostSayItsStep) {
    index::SeriesInfo info;
    info.times = {0, 2, 4};
    info.grid.vertices = {9, 9, 9};
    auto third = std::make_shared<index::InstantSurfaces>();
    third->query.instant = index::Instant(2);
    Picture picture;
    picture.isosurfaces.resize(1);
    picture.ghosts = {{third, {glm::vec3(1)}, 0.25f}};
    const auto last_line = [&](std::uint32_t step, bool on_slice) {
        const interaction::Pointed pointed{{{1, 2, 3}, index::Instant(step), 9.25}, 0, on_slice};
        return callouts_of(picture, pointed, info).back().lines.back();
    };
    EXPECT_EQ(last_line(2, false), "ghost: step 3");
    EXPECT_NE(last_line(1, false), "ghost: step 2") << "the surface itself";
    EXPECT_NE(last_line(2, true), "ghost: step 3") << "a slice";
}

TEST(MarkText, HasTheDigitsThatGridAndValuesCarryAndLosesTheLeastImportantPartFirst) {
    index::SeriesInfo info;
    info.times = {0, 2.908};
    info.time_unit = "s";
    info.array = "vorticity";
    info.value_unit = "1/s";
    info.length_unit = "m";
    info.grid.vertices = {64, 64, 64};
    info.grid.spacing = {0.1, 0.1, 0.1};
    info.type = index::ValueType::f32;
    const interaction::MarkedPoint point{{3.4159, 4.41, 5.6}, index::Instant(1), 9.446};
    EXPECT_EQ(mark_text(point, info), "x 3.42 y 4.41 z 5.60 m, vorticity 9.446 1/s, t 2.908 s");
    const auto within = [&](std::size_t letters) {
        return mark_text(point, info, [&](const auto& text) { return text.size() <= letters; });
    };
    EXPECT_EQ(within(47), "x 3.42 y 4.41 z 5.60 m, vorticity 9.446 1/s");
    EXPECT_EQ(within(30), "vorticity 9.446 1/s");
    EXPECT_EQ(within(12), "9.446 1/s");
    EXPECT_EQ(within(1), "9.446 1/s") << "the value is never cut";
    const struct {
        double spacing, place;
        const char* words;
    } rows[] = {{10, 4500000.25, "4500000"},
                {1, 12.34, "12.3"},
                {0.002, 0.12344, "0.1234"},
                {1e-9, 1.5e-8, "1.5e-08"},
                {25000, -3e10, "-3e+10"}};
    for (const auto& row : rows) {
        info.grid.spacing = glm::dvec3(row.spacing);
        EXPECT_EQ(mark_lines({glm::dvec3(row.place), {}, 1}, info)[1],
                  std::string("x ") + row.words + " y " + row.words + " z " + row.words + " m");
    }
    info.type = index::ValueType::f64;
    EXPECT_EQ(mark_lines({{}, {}, 101325.125}, info)[0], "vorticity 101325.125 1/s");
    info.type = index::ValueType::f32;
    EXPECT_EQ(mark_lines({{}, {}, 101325.125}, info)[0], "vorticity 101325 1/s");
    info.axis_names = {"longitude (degrees)", "latitude (degrees)", "height"};
    info.grid.spacing = {0.5, 0.5, 100};
    EXPECT_EQ(mark_lines({{12.25, -5, 1200}, {}, 1}, info)[1],
              "longitude 12.2 degrees latitude -5.0 degrees height 1200 m");
    info.grid.direction =
        glm::dmat3(0, 1, 0, 1, 0, 0, 0, 0, 1); // each axis of space has its spacing
    info.grid.spacing = {0.5, 10, 100};
    EXPECT_EQ(mark_lines({{12.25, -5, 1200}, {}, 1}, info)[1],
              "longitude 12 degrees latitude -5.0 degrees height 1200 m");
}

TEST(Callouts, NeverCoverEachOtherInEitherEye) {
    const render::GlyphAtlas atlas = room_font(32);
    const auto views = both_eyes();
    std::mt19937 random(test_seed());
    std::uniform_real_distribution<float> share(-1.0f, 1.0f);
    for (int round = 0; round < 300; ++round) {
        const glm::vec3 about(0.5f * share(random), 0.4f * share(random), -2.0f);
        const auto near = [&] {
            return about + 0.1f * glm::vec3(share(random), share(random), share(random));
        };
        const std::vector<Callout> callouts{mark_at(near()), length_at(near()), pointed_at(near())};
        const auto papers = papers_of(callouts, atlas, views);
        for (const render::View& view : views)
            for (std::size_t a = 0; a < callouts.size(); ++a) {
                const Box box = box_of(callouts[a], papers[a], view);
                EXPECT_GE(box[0], 0);
                EXPECT_LE(box[3], kSize.y);
                for (std::size_t b = 0; b < callouts.size(); ++b) {
                    if (a == b)
                        continue;
                    ASSERT_FALSE(overlap(box, box_of(callouts[b], papers[b], view)))
                        << a << " and " << b << " in round " << round;
                    const glm::vec2 reach(callouts[b].sign == CalloutSign::cross ? 0.6f : 0.0f);
                    EXPECT_FALSE(overlap(box, box_of(callouts[b], {-reach, reach}, view)) &&
                                 callouts[b].sign != CalloutSign::none)
                        << a << " lies over the sign of " << b << " in round " << round;
                }
            }
    }
}

TEST(Callouts, AloneStandAtTheRightAboveTheirPlaceAndInsideThePicture) {
    const render::GlyphAtlas atlas = room_font(32);
    const auto views = both_eyes();
    const CalloutPaper middle =
        papers_of(std::vector{pointed_at({0, 0, -2})}, atlas, views).front();
    EXPECT_GT(middle.low.x, 0);
    EXPECT_GT(middle.low.y, 0);
    const auto corner = std::vector{pointed_at({1.15f, 0.85f, -2})};
    const Box box = box_of(corner.front(), papers_of(corner, atlas, views).front(), views.front());
    EXPECT_LE(box[2], kSize.x);
    EXPECT_LE(box[3], kSize.y);
    const auto length = std::vector{length_at({0, 0, -2})};
    const CalloutPaper over = papers_of(length, atlas, views).front();
    EXPECT_NEAR(over.low.x, -over.high.x, 1e-5) << "a length stands on its line";
}

/// As WCAG 2.1 defines it.
double contrast(const glm::dvec3& a, const glm::dvec3& b) {
    const auto luminance = [](const glm::dvec3& color) {
        glm::dvec3 linear;
        for (int i = 0; i < 3; ++i)
            linear[i] =
                color[i] <= 0.04045 ? color[i] / 12.92 : std::pow((color[i] + 0.055) / 1.055, 2.4);
        return 0.2126 * linear.x + 0.7152 * linear.y + 0.0722 * linear.z;
    };
    const auto [dark, light] = std::minmax({luminance(a), luminance(b)});
    return (light + 0.05) / (dark + 0.05);
}

TEST(Callouts, LeaveTheCornerToTheCubeOfThePanelWhereThereIsOne) {
    constexpr float kShare = 15.0f / 960;
    const render::GlyphAtlas atlas = room_font(32);
    const auto views = both_eyes();
    const Box cube{1280 - 102, 960 - 102, 1280, 960};
    int reached = 0;
    for (float x = 0.7f; x < 1.1f; x += 0.01f) {
        const auto one = std::vector{pointed_at({x, 0.8f, -2})};
        const auto place = [&](bool panel) {
            return box_of(one.front(), papers_of(one, atlas, views, kShare, panel).front(),
                          views.front(), kShare);
        };
        reached += overlap(place(false), cube) ? 1 : 0;
        EXPECT_FALSE(overlap(place(true), cube)) << x;
        EXPECT_LE(place(true)[3], 960 - 49) << x << ": below the line of the tools";
    }
    EXPECT_GT(reached, 10) << "where there is no panel";
}

TEST(Callouts, CanBeReadOnEveryBackgroundWhateverColorTheirSurfaceHas) {
    const auto context = stereo::make_context(stereo::ContextKind::egl, {.size = {16, 16}});
    const render::Gl gl(context->loader());
    const render::TextPass text(gl, room_font);
    std::mt19937 random(test_seed());
    std::uniform_real_distribution<float> share(0.0f, 1.0f);
    for (int round = 0; round < 200; ++round) {
        Picture picture;
        picture.mark.point = interaction::MarkedPoint{};
        picture.tools.labels.push_back({.at = {0, 0, -2}, .text = "1.25 m"});
        picture.isosurfaces = {{8, {share(random), share(random), share(random)}, 1.0f}};
        for (const std::string_view name : interaction::kNames<interaction::Background>) {
            const auto background = *interaction::value_named<interaction::Background>(name);
            picture.look.background = background;
            const bool light = is_light(background);
            index::SeriesInfo info;
            info.times = {0};
            for (const Callout& callout : callouts_of(picture, interaction::Pointed{}, info)) {
                const CalloutPaper paper{{0, 0}, {9, 4}};
                const auto quads =
                    callout_quads(callout, paper, text, kSize, overlay_colors_on(background));
                std::optional<glm::vec4> halo; // around the letters that follow
                int letters = 0;
                for (const render::ScreenQuad& quad : quads) {
                    const bool is_halo = static_cast<int>(quad.letters) % 2 == 1;
                    if (is_halo)
                        halo = quad.color;
                    if (is_halo || quad.letters == 0)
                        continue;
                    ++letters;
                    ASSERT_TRUE(halo);
                    EXPECT_EQ(halo->x > 0.5f, light) << "as light as what is around the data";
                    for (const double behind : {0.0, 1.0}) {
                        const double cover = halo->w;
                        const glm::dvec3 seen = cover * glm::dvec3(*halo) + (1 - cover) * behind;
                        ASSERT_GE(contrast(quad.color, seen), 4.49)
                            << interaction::name_of(background) << ", round " << round;
                    }
                }
                EXPECT_GT(letters, 2);
            }
        }
    }
}

TEST(Callouts, AreAsHighAsTheWordsOfThePanel) {
    EXPECT_FLOAT_EQ(text_height({2560, 1440}, 15.0f / 1440), 15);
    EXPECT_FLOAT_EQ(text_height({2560, 1440}, 30.0f / 1440), 30) << "at twice the dots an inch";
    EXPECT_FLOAT_EQ(text_height({1280, 720}, 15.0f / 1440), 11) << "small pictures can be read";
}

TEST(Callouts, AStepOfAStoryStandsBesideItsPlaceBeforeAllOthers) {
    Picture picture;
    picture.room_from_physical = {{0, 0, -3}, glm::dquat(1, 0, 0, 0), 2};
    picture.marks = {{"kept", {}}};
    picture.told = ToldPlace{{0.25, 0.5, 0}, {"1 of 2: front", "It is here."}};
    const auto callouts = callouts_of(picture, {}, {});
    ASSERT_EQ(callouts.size(), 2u);
    EXPECT_EQ(callouts[0].at, glm::vec3(0.5f, 1.0f, -3.0f));
    EXPECT_EQ(callouts[0].lines, picture.told->lines);
    EXPECT_EQ(callouts[0].sign, CalloutSign::dot);
}

} // namespace
} // namespace isochron::app
