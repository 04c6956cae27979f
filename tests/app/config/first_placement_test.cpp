// The first placement of a volume in the room: what is up in the data is up in the room.
#include "app/config/first_placement.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

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

} // namespace
} // namespace isochron::app
