// Where the data lie in the view, and what a clip plane leaves of them.
#include "app/scene/data_sight.h"

#include <gtest/gtest.h>

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>

#include <vector>

namespace isochron::app {
namespace {

index::Grid cube() {
    index::Grid grid;
    grid.vertices = {11, 11, 11};
    return grid;
}

/// An eye at the room's origin that looks to -Z, or wherever it is turned to.
render::View looking(const glm::vec3& at, const glm::vec3& from = glm::vec3(0)) {
    return {.clip_from_eye = glm::perspective(1.0f, 1.5f, 0.05f, 50.0f),
            .eye_from_room = glm::lookAt(from, at, glm::vec3(0, 1, 0)),
            .size = {900, 600}};
}

/// The cube's middle at a place in the room, a meter wide.
interaction::Similarity placed(const glm::dvec3& middle, double size = 1.0) {
    interaction::Similarity place;
    place.scale = size / 10;
    place.translation = middle - glm::dvec3(size / 2);
    return place;
}

Sight of_cube(const interaction::Similarity& place, std::vector<render::View> views) {
    return sight_of(corners_of(cube()), place, views);
}

TEST(DataSight, TellsWhereTheDataAre) {
    const render::View ahead = looking({0, 0, -1});
    EXPECT_EQ(of_cube(placed({0, 0, -3}), {ahead}), Sight::in_view);
    EXPECT_EQ(of_cube(placed({0, 0, 3}), {ahead}), Sight::behind);
    EXPECT_EQ(of_cube(placed({9, 0, -3}), {ahead}), Sight::out_of_view);
    EXPECT_EQ(of_cube(placed({0, -9, -3}), {ahead}), Sight::out_of_view);
    EXPECT_EQ(of_cube(placed({0, 0, -90}), {ahead}), Sight::out_of_view) << "beyond the far plane";
    EXPECT_EQ(of_cube(placed({0, 0, -3}, 1e-3), {ahead}), Sight::too_small);
    EXPECT_EQ(of_cube(placed({0, 0, 0}, 5), {ahead}), Sight::in_view)
        << "the eye is among the data";
    EXPECT_EQ(of_cube(placed({0, 0, 3}), {}), Sight::in_view) << "nobody looks";
}

TEST(DataSight, WhatOneOfTwoViewsShowsIsInView) {
    const std::vector<render::View> both{looking({0, 0, -1}), looking({0, 0, 1})};
    EXPECT_EQ(of_cube(placed({0, 0, 3}), both), Sight::in_view);
    EXPECT_EQ(of_cube(placed({0, 30, 0}), both), Sight::out_of_view);
}

/// Cells of one surface.
index::Extraction with_cells(std::vector<index::CellId> ids) {
    index::Extraction cells;
    cells.surfaces.resize(2);
    cells.surfaces[1].ids = std::move(ids);
    return cells;
}

TEST(DataSight, SurfacesLieInTheBoxOfTheirCells) {
    const index::Grid grid = cube();
    const index::Extraction cells = with_cells({0, 111, 111 + 100}); // cells 0 0 0, 1 1 1, 1 1 2
    const auto box = corners_of(cells, grid, 0b10);
    ASSERT_TRUE(box);
    EXPECT_EQ((*box)[0], glm::dvec3(0));
    EXPECT_EQ((*box)[7], glm::dvec3(2, 2, 3));
    EXPECT_FALSE(corners_of(cells, grid, 0b01)) << "the other surface has none";
}

TEST(DataSight, AllIsCutAwayWhereNoVisibleCellReachesTheSideThatStays) {
    const index::Grid grid = cube();
    const index::Extraction cells = with_cells({333, 444}); // cells 3 3 3 and 4 4 4
    interaction::ClipPlane clip{.shown = true, .point = {5.5, 0, 0}, .normal = {-1, 0, 0}};
    EXPECT_TRUE(is_cut_away(cells, grid, 0b10, {&clip, 1}));
    clip.point.x = 4.5;
    EXPECT_FALSE(is_cut_away(cells, grid, 0b10, {&clip, 1})) << "a part of a cell stays";
    EXPECT_FALSE(is_cut_away(cells, grid, 0b10, {}));
    clip = {.shown = true, .point = {0, 0, -1}, .normal = {0, 0, 1}};
    EXPECT_TRUE(is_cut_away(cells, grid, 0b10, {&clip, 1})) << "the whole box";
}

} // namespace
} // namespace isochron::app
