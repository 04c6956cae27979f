// The choice of numbers of cells and levels: by view and budget, with hysteresis.
#include "app/quality/detail_chooser.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <random>
#include <set>

namespace isochron::app {
namespace {

constexpr int kParts = index::DetailQuery::kPartsOfLevel;

index::Grid cube(std::uint32_t vertices) {
    index::Grid grid;
    grid.vertices = {vertices, vertices, vertices};
    return grid;
}

/// The volume is a meter wide, and its middle is at the room's origin.
render::Placement a_meter_wide(const index::Grid& grid) {
    const float voxel = 1.0f / static_cast<float>(grid.cells()[0]);
    render::Placement placement;
    placement.room_from_index =
        glm::scale(glm::translate(glm::mat4(1.0f), glm::vec3(-0.5f)), glm::vec3(voxel));
    placement.extent = glm::vec3(static_cast<float>(grid.cells()[0]));
    return placement;
}

render::View view_from(float distance, int pixels, bool away = false) {
    render::View view;
    view.size = {pixels, pixels};
    view.clip_from_eye = glm::perspective(1.0f, 1.0f, 0.01f, 100.0f);
    view.eye_from_room = glm::lookAt(glm::vec3(0, 0, distance),
                                     glm::vec3(0, 0, away ? 2 * distance : 0), glm::vec3(0, 1, 0));
    return view;
}

TEST(DetailChooser, AVoxelAtRestIsOfLevelZeroWhereverItIsLargerThanHalfAPixel) {
    const index::Grid grid = cube(513);
    const index::DetailRegions regions(grid);
    const render::Placement placement = a_meter_wide(grid);
    std::mt19937 random(7);
    int coarse = 0, small = 0;
    for (int i = 0; i < 40; ++i) {
        const float distance = std::uniform_real_distribution<float>(1.5f, 12.0f)(random);
        const render::View view = view_from(distance, 400);
        DetailChooser choice(grid, 1'000'000);
        choice.look(std::span(&view, 1), placement);
        const auto wished = choice.at_first_rest(1'000'000).wished;
        const auto last = choice.at_rest().wished;
        const float scale = 200.0f * view.clip_from_eye[1][1];
        for (std::size_t r = 0; r < wished.size(); ++r) {
            const auto at = regions.at(r);
            const glm::vec3 eye(256.0f, 256.0f, 256.0f + 512.0f * distance);
            const glm::vec3 low = 32.0f * glm::vec3(at[0], at[1], at[2]);
            const float far = glm::length(eye - glm::clamp(eye, low, low + 32.0f)) / 512.0f;
            const float pixels = scale / 512.0f / far;
            if (pixels > 0.5f) {
                EXPECT_EQ(wished[r], 0) << pixels;
            }
            if (wished[r] > 0) {
                EXPECT_LE(std::exp2(float(wished[r]) / kParts) * pixels, 0.708f);
                EXPECT_EQ(wished[r] % kParts, 0) << "whole levels";
                ++coarse;
            }
            if (last.empty())
                continue;
            if (pixels > 0.125f) {
                EXPECT_EQ(last[r], 0) << pixels;
            }
            if (last[r] > 0) {
                EXPECT_LE(std::exp2(float(last[r]) / kParts) * pixels, 0.251f);
                EXPECT_LT(last[r], wished[r]);
                ++small;
            }
        }
    }
    EXPECT_GT(coarse, 100);
    EXPECT_GT(small, 100);
}

TEST(DetailChooser, NearRegionsAreFinerAndUnseenOnesCoarser) {
    const index::Grid grid = cube(513);
    const index::DetailRegions regions(grid);
    DetailChooser choice(grid, 1'000'000);
    const std::array views{view_from(0.6f, 1000)};
    choice.look(views, a_meter_wide(grid));
    const auto wished = choice.for_motion(1e6, 0).wished;
    EXPECT_LT(wished[regions.number({8, 8, 15})], wished[regions.number({8, 8, 0})]);
    // One that looks at it decides for all.
    DetailChooser both(grid, 1'000'000), behind(grid, 1'000'000);
    const std::array two{views[0], view_from(0.6f, 1000, true)};
    both.look(two, a_meter_wide(grid));
    behind.look(std::span(two).last(1), a_meter_wide(grid));
    EXPECT_EQ(both.for_motion(1e6, 0).wished, wished);
    EXPECT_EQ(behind.for_motion(1e6, 0).wished[regions.number({8, 8, 15})],
              wished[regions.number({8, 8, 15})] + 2 * kParts);
}

TEST(DetailChooser, CellsLookSmallWhereTheyTakeAFewPixels) {
    const index::Grid grid = cube(129);
    DetailChooser choice(grid, 1'000'000);
    EXPECT_FALSE(choice.cells_look_small()) << "nobody has looked yet";
    const float one_pixel = 1.0f / std::tan(0.5f) * 500 / 128; // [m] from the nearest cells
    for (const float pixels : {1.0f, 5.0f, 7.0f, 20.0f}) {
        const render::View view = view_from(0.5f + one_pixel / pixels, 1000);
        choice.look(std::span(&view, 1), a_meter_wide(grid));
        EXPECT_EQ(choice.cells_look_small(), pixels < DetailChooser::kSmallCell) << pixels;
    }
}

TEST(DetailChooser, OnStretchedAxesAVoxelIsAsLargeAsItIsSeen) {
    index::Grid grid = cube(513);
    std::vector<double> at{0.0};
    while (at.size() < 513) // cells of the left half are a quarter as wide as the others
        at.push_back(at.back() + (at.size() <= 256 ? 0.4 : 1.6));
    grid.positions[0] = index::AxisPositions(at);
    const index::DetailRegions regions(grid);
    DetailChooser choice(grid, 1'000'000), even(cube(513), 1'000'000);
    const std::array views{view_from(2.0f, 1000)};
    choice.look(views, a_meter_wide(grid));
    even.look(views, a_meter_wide(cube(513)));
    const auto wished = choice.for_motion(1e6, 0).wished, of_even = even.for_motion(1e6, 0).wished;
    // The other axes are even: narrow cells are as tall as before, wide ones are wider.
    EXPECT_EQ(wished[regions.number({2, 8, 8})], of_even[regions.number({2, 8, 8})]);
    EXPECT_LT(wished[regions.number({13, 8, 8})], of_even[regions.number({13, 8, 8})]);
    const std::array near{view_from(0.5f, 1000)};
    choice.look(near, a_meter_wide(grid));
    EXPECT_GT(choice.for_motion(1e6, 0).wished[regions.number({0, 8, 0})],
              choice.for_motion(1e6, 0).wished[regions.number({15, 8, 0})]);
}

TEST(DetailChooser, AHeadThatSwaysAsksForNothingNew) {
    const index::Grid grid = cube(513);
    DetailChooser choice(grid, 1'000'000);
    std::set<std::vector<std::int8_t>> asked;
    for (int i = 0; i < 200; ++i) {
        const auto view = view_from(2.0f + 0.02f * std::sin(0.1f * float(i)), 1000);
        choice.look(std::span(&view, 1), a_meter_wide(grid));
        const auto wished = choice.for_motion(1e6, 0).wished;
        if (i >= 63) // it has been at all places
            asked.insert(wished);
    }
    EXPECT_EQ(asked.size(), 1u);
}

TEST(DetailChooser, WhatAPictureIsRecognizedByIsChosenAtOnceWhateverFits) {
    DetailChooser choice(cube(513), 3'000'000);
    EXPECT_LT(choice.for_motion(1'000, 0).most_cells, 10'000u);
    const std::uint64_t cells = choice.for_motion(1'000, 4096, 300'000).most_cells;
    EXPECT_GE(cells, 300'000u);
    EXPECT_LE(cells, 450'000u);
    EXPECT_EQ(choice.for_motion(1'000, cells, 300'000).most_cells, cells);
    EXPECT_LE(choice.for_motion(1'000, cells, 5'000'000'000).most_cells, 3'000'000u);
    EXPECT_LT(choice.for_motion(1'000, cells, 0).most_cells, 10'000u);
}

TEST(DetailChooser, NumbersOfCellsFitAndAreLeftLate) {
    DetailChooser choice(cube(513), 3'000'000);
    std::mt19937 random(3);
    std::set<std::uint64_t> chosen;
    std::uint64_t drawn = 0;
    for (int i = 0; i < 300; ++i) { // measurements scatter by a tenth
        const double fit = 200'000 * std::uniform_real_distribution<double>(0.95, 1.05)(random);
        const std::uint64_t cells = choice.for_motion(fit, drawn).most_cells;
        EXPECT_LE(0.9 * double(cells), fit);
        chosen.insert(cells);
        EXPECT_LE(drawn == 0 ? 0 : cells, 2 * drawn) << "not known so far away";
        drawn = cells;
    }
    EXPECT_LE(chosen.size(), 2u);
    EXPECT_EQ(choice.for_motion(0, drawn).most_cells, DetailChooser::kFewest);
    EXPECT_EQ(choice.for_motion(1e9, drawn).most_cells, DetailChooser::kFewest) << "not yet drawn";
    for (drawn = 0; drawn < 3'000'000;) {
        const std::uint64_t cells = choice.for_motion(1e9, drawn).most_cells;
        ASSERT_GT(cells, drawn);
        drawn = cells;
    }
    EXPECT_EQ(choice.for_motion(1e9, drawn).most_cells, 3'000'000u);
    choice.limit(100'000);
    EXPECT_EQ(choice.for_motion(1e9, drawn).most_cells, 100'000u);
    EXPECT_EQ(choice.at_rest().most_cells, 100'000u);
    EXPECT_TRUE(DetailChooser(cube(65), 1000).small());
    EXPECT_FALSE(DetailChooser(cube(66), 1000).small());
    DetailChooser little(cube(65), 100'000);
    little.limit(50'000);
    EXPECT_FALSE(little.small()) << "it does not fit as it is";
    EXPECT_EQ(little.most(), 50'000u);
}

TEST(DetailChooser, WhatFitsIsUsedByTheSecondSet) {
    DetailChooser choice(cube(513), 3'000'000);
    std::uint64_t drawn = choice.for_motion({}, 0).most_cells;
    EXPECT_EQ(drawn, DetailChooser::kAtFirst);
    for (int set = 0; set < 2; ++set)
        drawn = choice.for_motion(1e6, drawn).most_cells;
    EXPECT_GE(1.5 * 1.4 * double(drawn), 1e6);
    EXPECT_LE(double(drawn), 1e6);
}

TEST(DetailChooser, RegionsFarBesideAllViewsCountForNothingInWhatMoves) {
    const index::Grid grid = cube(513);
    const index::DetailRegions regions(grid);
    const auto turned = [&](float degrees) {
        render::View view = view_from(0.6f, 1000); // half of it is seen 29 degrees to each side
        view.eye_from_room =
            glm::rotate(glm::mat4(1.0f), glm::radians(degrees), glm::vec3(0, 1, 0)) *
            view.eye_from_room;
        return view;
    };
    const auto wished_of = [&](std::span<const render::View> views, std::uint64_t least,
                               std::size_t region) {
        DetailChooser choice(grid, 1'000'000);
        choice.look(views, a_meter_wide(grid));
        return choice.for_motion(100'000, 0, least).wished[region];
    };
    constexpr std::uint64_t kScarce = 100'000;
    const std::size_t left = regions.number({0, 8, 8});
    const std::array away{turned(60)}, back{turned(-60)};
    const int nothing = 8 * kParts;
    const auto at_left = wished_of(away, kScarce, left), other = wished_of(back, kScarce, left);
    EXPECT_TRUE((at_left == nothing) != (other == nothing)) << "one of the two looks to the left";
    const std::array both{away[0], back[0]};
    EXPECT_LT(wished_of(both, kScarce, left), nothing) << "somebody sees it";
    // Just beside the view, where a head may turn within a moment, nothing is given up.
    const std::array ahead{turned(0)};
    DetailChooser choice(grid, 1'000'000);
    choice.look(ahead, a_meter_wide(grid));
    const auto wished = choice.for_motion(100'000, 0, kScarce).wished;
    ASSERT_EQ(wished.size(), regions.size());
    EXPECT_LT(std::ranges::count(wished, nothing), static_cast<int>(regions.size()) / 2);
    // Where all cells fit, none are given up.
    for (const std::array<render::View, 1>& view : {away, back})
        EXPECT_LT(wished_of(view, 10'000, left), nothing);
}

TEST(DetailChooser, ASetThatWasChosenForOtherViewsLacksWhatTheseShow) {
    const index::Grid grid = cube(513);
    const auto turned = [&](float degrees) {
        render::View view = view_from(0.6f, 1000);
        view.eye_from_room =
            glm::rotate(glm::mat4(1.0f), glm::radians(degrees), glm::vec3(0, 1, 0)) *
            view.eye_from_room;
        return std::array{view};
    };
    const auto lacks = [&](float then, float now, std::uint64_t least) {
        DetailChooser choice(grid, 1'000'000);
        choice.look(turned(then), a_meter_wide(grid));
        const index::DetailQuery chosen = choice.for_motion(100'000, 0, least);
        choice.look(turned(now), a_meter_wide(grid));
        return choice.lacks_what_is_seen(chosen);
    };
    constexpr std::uint64_t kScarce = 100'000;
    EXPECT_TRUE(lacks(60, -60, kScarce));
    EXPECT_TRUE(lacks(-60, 0, kScarce));
    EXPECT_FALSE(lacks(60, 60, kScarce));
    EXPECT_FALSE(lacks(60, 50, kScarce)) << "heads turn a little";
    EXPECT_FALSE(lacks(60, -60, 10'000)) << "no region was left out";
    // It is made anew for the views of now, also where fewer cells fit than then; once.
    DetailChooser dearer(grid, 1'000'000);
    dearer.look(turned(60), a_meter_wide(grid));
    const index::DetailQuery then = dearer.for_motion(200'000, 0, kScarce);
    dearer.look(turned(-60), a_meter_wide(grid));
    const index::DetailQuery now = dearer.for_motion(50'000, 0, kScarce);
    EXPECT_LT(now.most_cells, then.most_cells);
    EXPECT_TRUE(dearer.is_for_other_views(then, now));
    EXPECT_FALSE(dearer.is_for_other_views(now, now));
    EXPECT_FALSE(dearer.is_for_other_views(then, then)) << "another one would be the same";
    // A set whose levels were not chosen by views lacks nothing.
    DetailChooser choice(grid, 1'000'000);
    choice.look(turned(0), a_meter_wide(grid));
    EXPECT_FALSE(choice.lacks_what_is_seen({}));
}

TEST(DetailChooser, CellsThatNobodySeesMakeNoRoomForMore) {
    const index::Grid grid = cube(513);
    DetailChooser choice(grid, 1'000'000);
    std::uint64_t drawn = 0;
    const auto cells = [&](const render::View& view, double fit) {
        choice.look(std::span(&view, 1), a_meter_wide(grid));
        for (int i = 0; i < 20; ++i)
            drawn = choice.for_motion(fit, drawn).most_cells;
        return drawn;
    };
    const render::View whole = view_from(2.0f, 1000);
    render::View half = whole;
    half.eye_from_room =
        glm::translate(glm::mat4(1.0f), glm::vec3(0.8f, 0, 0)) * whole.eye_from_room;
    const std::uint64_t chosen = cells(whole, 100'000);
    EXPECT_EQ(cells(half, 1e6), chosen) << "the head turns back soon";
    EXPECT_GT(cells(whole, 1e6), chosen);
    const std::uint64_t fewer = cells(half, 50'000);
    EXPECT_LT(fewer, chosen);
    EXPECT_GT(cells(half, 1e6), fewer) << "chosen where as much was seen";
}

} // namespace
} // namespace isochron::app
