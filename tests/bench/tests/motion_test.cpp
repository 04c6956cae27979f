// What the motion benchmark measures, on pictures and frames made by hand.
#include "tests/bench/motion/asked_shown.h"
#include "tests/bench/motion/cases.h"
#include "tests/bench/motion/fields.h"
#include "tests/bench/motion/likeness.h"
#include "tests/bench/motion/rows.h"
#include "tests/bench/motion/script.h"

#include <gmock/gmock.h>

#include <cmath>

namespace isochron::bench {
namespace {

using render::Image;
using testing::DoubleNear;
using testing::ElementsAre;

constexpr std::uint8_t kDark = 10;

Image dark(int width, int height) {
    Image image{width, height, {}};
    image.rgba.assign(4 * static_cast<std::size_t>(width) * height, kDark);
    return image;
}

/// Adds a gray rectangle.
Image with(Image image, int left, int top, int width, int height, std::uint8_t gray) {
    for (int y = top; y < top + height; ++y)
        for (int x = left; x < left + width; ++x)
            for (int c = 0; c < 3; ++c)
                image.rgba[4 * (static_cast<std::size_t>(y) * image.width + x) + c] = gray;
    return image;
}

TEST(Likeness, OfAPictureWithItselfIsPerfect) {
    const Image settled = with(dark(64, 64), 10, 10, 20, 20, 200);
    const Likeness like = likeness(settled, settled, dark(64, 64));
    EXPECT_EQ(like.lit, 1);
    EXPECT_EQ(like.overlap, 1);
    EXPECT_EQ(like.luminance_off, 0);
    EXPECT_EQ(like.block_lit_off, 0);
    EXPECT_EQ(like.block_light_off, 0);
    EXPECT_EQ(like.specks, 0);
    EXPECT_EQ(like.pixels_off, 0);
    EXPECT_TRUE(is_recognizable(like));
}

TEST(Likeness, LitIsWhatDiffersByMoreThanEightFromTheViewWithoutCells) {
    const Image without = dark(8, 8);
    EXPECT_EQ(lit_pixels(with(without, 2, 2, 3, 2, kDark + 9), without).count(), 6u);
    EXPECT_EQ(lit_pixels(with(without, 2, 2, 3, 2, kDark + 8), without).count(), 0u);
    EXPECT_EQ(lit_pixels(with(without, 2, 2, 3, 2, kDark - 9), without).count(), 6u)
        << "cells may be darker than what is behind them";
    Image red = without;
    red.rgba[4] = 255;
    red.rgba[11] = 255; // alpha of the third pixel
    EXPECT_EQ(lit_pixels(red, without).count(), 1u);
}

TEST(Likeness, CountsAreasAndTheirOverlapWidenedByAPixel) {
    const Image without = dark(64, 64);
    const Image settled = with(without, 10, 10, 20, 20, 200);
    const Image moving = with(without, 10, 10, 30, 20, 200);
    const Likeness like = likeness(moving, settled, without);
    EXPECT_DOUBLE_EQ(like.lit, 1.5);
    EXPECT_DOUBLE_EQ(like.overlap, (22.0 * 22) / (32 * 22));
    EXPECT_DOUBLE_EQ(like.pixels_off, 200.0 / (64 * 64));
    EXPECT_FALSE(is_recognizable(like));
    const Likeness shifted = likeness(with(without, 15, 10, 20, 20, 200), settled, without);
    EXPECT_EQ(shifted.lit, 1);
    EXPECT_DOUBLE_EQ(shifted.overlap, 17.0 / 27);
    EXPECT_FALSE(is_recognizable(shifted)) << "as large, in another place";
}

TEST(Likeness, WidenedMasksEndAtThePicturesEdge) {
    const Image without = dark(8, 4);
    const PixelMask corner = widened(lit_pixels(with(without, 0, 0, 1, 1, 200), without));
    EXPECT_EQ(corner.count(), 4u);
    const PixelMask end = widened(lit_pixels(with(without, 7, 1, 1, 1, 200), without));
    EXPECT_EQ(end.count(), 6u);
    EXPECT_FALSE(end.at(0, 2)) << "the next row begins there";
}

TEST(Likeness, ComparesLuminanceOnlyWhereBothAreLit) {
    const Image without = dark(64, 64);
    const Image settled = with(without, 10, 10, 20, 20, 200);
    // Half of what both light is brighter, half darker; what only one lights does not count.
    Image moving = with(without, 10, 10, 20, 10, 220);
    moving = with(with(moving, 10, 20, 20, 10, 180), 40, 40, 10, 10, 255);
    const Likeness like = likeness(moving, settled, without);
    EXPECT_NEAR(like.luminance_off, 0.1, 1e-9);
    EXPECT_NEAR(like.luminance_shift, 0, 1e-9);
    EXPECT_NEAR(likeness(with(without, 10, 10, 20, 20, 150), settled, without).luminance_shift,
                0.25, 1e-9);
}

TEST(Likeness, WhereNothingIsLitNothingIsMissed) {
    const Image without = dark(16, 16), lit = with(without, 3, 3, 4, 4, 200);
    EXPECT_EQ(likeness(without, without, without).lit, 1);
    EXPECT_EQ(likeness(without, without, without).overlap, 1);
    EXPECT_EQ(likeness(without, lit, without).lit, 0);
    EXPECT_EQ(likeness(without, lit, without).overlap, 0);
    EXPECT_TRUE(std::isinf(likeness(lit, without, without).lit));
    EXPECT_FALSE(is_recognizable(likeness(lit, without, without)));
}

TEST(Likeness, TellsSpecksFromThings) {
    const Image without = dark(64, 64);
    Image specks = with(without, 1, 1, 1, 1, 200);                 // one pixel
    specks = with(with(specks, 5, 5, 1, 2, 200), 6, 7, 1, 1, 200); // three that touch by a corner
    EXPECT_EQ(specks_in(lit_pixels(specks, without)), 1);
    const Image more = with(specks, 20, 20, 2, 2, 200); // four are no speck
    EXPECT_DOUBLE_EQ(specks_in(lit_pixels(more, without)), 0.5);
}

TEST(Likeness, SpecksAreComparedInBlocks) {
    const Image without = dark(64, 64);
    Image settled = without, beside = without, doubled = without;
    for (int y = 4; y < 64; y += 8)
        for (int x = 4; x < 64; x += 8) {
            settled = with(settled, x, y, 1, 1, 200);
            beside = with(beside, x + 2, y + 2, 1, 1, 200);
            doubled = with(with(doubled, x, y, 1, 1, 200), x + 2, y + 2, 1, 1, 200);
        }
    const Likeness moved = likeness(beside, settled, without);
    EXPECT_LT(moved.overlap, 0.3) << "no speck lies on itself";
    EXPECT_EQ(moved.block_lit_off, 0) << "and yet all blocks are alike";
    EXPECT_TRUE(is_recognizable(moved));
    const Likeness more = likeness(doubled, settled, without);
    EXPECT_EQ(more.block_lit_off, 1);
    EXPECT_DOUBLE_EQ(more.block_light_off, 1);
    EXPECT_FALSE(is_recognizable(more));
    const Likeness elsewhere = likeness(with(without, 0, 0, 8, 8, 200), settled, without);
    EXPECT_EQ(elsewhere.lit, 1) << "as many pixels";
    EXPECT_GT(elsewhere.block_lit_off, 1);
}

app::FrameReport report(double time, double asked, std::optional<double> shown) {
    app::FrameReport report;
    report.time = interaction::Seconds(time);
    report.asked = {index::Instant(0), {asked}};
    if (shown)
        report.shown = index::SurfacesQuery{index::Instant(0), {*shown}};
    return report;
}

TEST(AskedShown, MeasuresUntilAQueryOrANewerOneIsShown) {
    AskedShown asked;
    asked.add(report(0.0, 1, 1), 0.01);
    asked.add(report(0.1, 2, 1), 0.11); // asked at 0.1, and replaced
    asked.add(report(0.2, 3, 1), 0.21); // asked at 0.2
    asked.add(report(0.3, 4, 1), 0.31); // asked at 0.3, the last
    EXPECT_EQ(asked.unanswered(), 3u);
    asked.add(report(0.4, 4, 3), 0.45); // answers 2 and 3
    EXPECT_THAT(asked.milliseconds(), ElementsAre(DoubleNear(350, 1e-6), DoubleNear(250, 1e-6)));
    asked.add(report(0.5, 4, 4), 0.51);
    EXPECT_THAT(asked.milliseconds(),
                ElementsAre(DoubleNear(350, 1e-6), DoubleNear(250, 1e-6), DoubleNear(210, 1e-6)));
    EXPECT_EQ(asked.unanswered(), 0u);
}

TEST(AskedShown, OfAMotionThatAsksForNothingTheFrameIsTheAnswer) {
    AskedShown asked;
    app::FrameReport frame;
    for (const double at : {1.0, 2.0, 3.0}) {
        frame.time = interaction::Seconds(at);
        frame.redrawn = at != 2.0;
        asked.add_moved(frame, at + 0.025);
    }
    EXPECT_EQ(asked.milliseconds().size(), 2u);
    EXPECT_NEAR(*asked.percentile(95), 25, 1e-6);
}

TEST(AskedShown, ALevelOfDetailIsAnAnswer) {
    AskedShown asked;
    asked.add(report(0.0, 1, 1), 0.01);
    app::FrameReport coarse = report(0.1, 2, 2);
    coarse.asked.detail.most_cells = 100;
    coarse.shown->detail.most_cells = 5;
    asked.add(coarse, 0.15);
    EXPECT_THAT(asked.milliseconds(), ElementsAre(DoubleNear(50, 1e-6)));
    EXPECT_NEAR(*asked.percentile(95), 50, 1e-6);
    EXPECT_EQ(AskedShown().percentile(50), std::nullopt);
}

TEST(MotionScript, SaysTheSameForAMomentWhoeverAsks) {
    app::ExplorerState state;
    state.set_isovalue(2);
    for (std::size_t i = 0; i < kMotionNames.size(); ++i) {
        const auto motion = motion_from_name(kMotionNames[i]);
        EXPECT_EQ(name_of(motion), kMotionNames[i]);
        const MotionScript script(motion, 2, state, {1, 1, 1}, 4);
        const auto early = script.input(0.5, 0.7), late = script.input(9, 0.7);
        EXPECT_EQ(early.devices, late.devices);
        EXPECT_EQ(script.commands(0.7), script.commands(0.7));
        EXPECT_TRUE(script.commands(0.7) != script.commands(1.3) ||
                    early.devices != script.input(0.5, 1.3).devices)
            << "nothing moves in " << kMotionNames[i];
    }
}

TEST(MotionScript, AnOrbitTurnsTheDataAboutTheirMiddle) {
    app::ExplorerState state;
    state.room_from_physical.translation = {0.3, 1.6, -3};
    state.room_from_physical.scale = 0.1;
    const glm::dvec3 middle(4, 5, 6);
    const MotionScript script(Motion::orbit, 2, state, middle, 1);
    const auto place = [&](const interaction::Similarity& at, const glm::dvec3& point) {
        return glm::dvec3(interaction::matrix(at) * glm::dvec4(point, 1));
    };
    const auto turned = script.commands(1.5).room_from_physical;
    ASSERT_TRUE(turned);
    EXPECT_LT(glm::distance(place(*turned, middle), place(state.room_from_physical, middle)), 1e-9);
    EXPECT_GT(glm::distance(place(*turned, {}), place(state.room_from_physical, {})), 0.1);
}

TEST(MotionData, AreTheSameEachTime) {
    constexpr std::size_t kSize = 24;
    for (const auto& make : {tubes_of, specks_of}) {
        std::vector<float> first(kSize * kSize * kSize), again = first, later = first;
        make(kSize)(1, first);
        make(kSize)(1, again);
        make(kSize)(2, later);
        EXPECT_EQ(first, again);
        EXPECT_NE(first, later);
        EXPECT_GT(*std::ranges::max_element(first), 0.5);
        EXPECT_LT(*std::ranges::min_element(first), 0.1);
    }
}

TEST(MotionCases, LargeDataAreForAllOfIt) {
    const auto has_large = [](const CaseOptions& options) {
        const auto cases = cases_of(options);
        return std::ranges::any_of(cases, [](const MotionCase& of) { return of.data.large; });
    };
    EXPECT_FALSE(has_large({}));
    EXPECT_TRUE(has_large({.full = true}));
    for (const MotionCase& of :
         cases_of({.data = {"192"}, .motions = {Motion::orbit}, .budgets = {33}})) {
        EXPECT_EQ(of.data.name, "192");
        EXPECT_THAT(of.motions, ElementsAre(Motion::orbit));
        EXPECT_THAT(of.budgets, ElementsAre(33));
    }
}

} // namespace
} // namespace isochron::bench
