// The first placement of a volume in the room: what is up in the data is up in the room.
#include "app/config/first_placement.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace isochron::app {
namespace {

glm::dvec3 in_room(index::Anatomy anatomy, const glm::dvec3& direction) {
    index::SeriesInfo info;
    info.anatomy = anatomy;
    info.grid.vertices = {3, 4, 5};
    return place(info, {}).rotation * direction;
}

void expect_near(const glm::dvec3& got, const glm::dvec3& expected) {
    EXPECT_LT(glm::distance(got, expected), 1e-12) << got.x << " " << got.y << " " << got.z;
}

TEST(Placement, KeepsHeadsAndSkiesUp) {
    for (const auto anatomy : {index::Anatomy::ras, index::Anatomy::lps, index::Anatomy::enu})
        expect_near(in_room(anatomy, {0, 0, 1}), {0, 1, 0});
    expect_near(in_room(index::Anatomy::none, {0, 1, 0}), {0, 1, 0});
}

TEST(Placement, ShowsTheEarthFromTheSouth) {
    expect_near(in_room(index::Anatomy::enu, {1, 0, 0}), {1, 0, 0});
    expect_near(in_room(index::Anatomy::enu, {0, 1, 0}), {0, 0, -1});
}

/// Cosine between the way to the viewer and what was a direction in the data.
double towards_viewer(index::Anatomy anatomy, const glm::dvec3& spacing, const glm::dvec3& axis) {
    index::SeriesInfo info;
    info.anatomy = anatomy;
    info.grid.vertices = {11, 11, 11};
    info.grid.spacing = spacing;
    return (place(info, {}).rotation * axis).z;
}

TEST(Placement, ShowsAFlatSlabFromItsBroadSideAndALyingOneFromAbove) {
    using index::Anatomy;
    // The sky's side of a layer of air is seen, and so is north behind south.
    EXPECT_NEAR(towards_viewer(Anatomy::enu, {1, 1, 0.1}, {0, 0, 1}), 0.82, 0.01);
    EXPECT_NEAR(towards_viewer(Anatomy::enu, {1, 1, 0.1}, {1, 0, 0}), 0, 1e-12);
    EXPECT_LT(towards_viewer(Anatomy::enu, {1, 1, 0.1}, {0, 1, 0}), 0);
    EXPECT_NEAR(towards_viewer(Anatomy::none, {1, 0.1, 1}, {0, 1, 0}), 0.82, 0.01);
    EXPECT_NEAR(std::abs(towards_viewer(Anatomy::none, {0.1, 1, 1}, {1, 0, 0})), 0.82, 0.01);
    // What is seen from its broad side stays, and so does what is no slab.
    EXPECT_EQ(towards_viewer(Anatomy::none, {1, 1, 0.1}, {0, 0, 1}), 1);
    EXPECT_EQ(towards_viewer(Anatomy::ras, {1, 0.1, 1}, {0, -1, 0}), -1);
    EXPECT_NEAR(towards_viewer(Anatomy::enu, {1, 1, 0.5}, {0, 0, 1}), 0, 1e-12);
    EXPECT_NEAR(towards_viewer(Anatomy::enu, {0.1, 1, 0.1}, {0, 0, 1}), 0, 1e-12);
}

} // namespace
} // namespace isochron::app
