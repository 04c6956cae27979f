// The first placement of a volume in the room: what is up in the data is up in the room.
#include "app/config/first_placement.h"

#include "interaction/navigation/navigation.h"
#include "stereo/screen.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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

TEST(Placement, FillsThePictureSeenFromAboveAndFromACorner) {
    const stereo::Screen screen{
        {-0.9f, -0.5f, -1.2f}, {-0.9f, 0.5f, -1.2f}, {0.9f, 0.5f, -1.2f}, true, 0, true};
    const interaction::Pose head{{0, 1.6f, 0}, {1, 0, 0, 0}};
    const PlacementOptions options{.size = 1.5, .height = 1.6, .distance = 3, .fill = 0.85};
    for (const auto anatomy :
         {index::Anatomy::none, index::Anatomy::ras, index::Anatomy::lps, index::Anatomy::enu})
        for (const glm::ivec2 picture : {glm::ivec2(980, 712), glm::ivec2(596, 392),
                                         glm::ivec2(600, 900), glm::ivec2(2000, 500)})
            for (const std::array<unsigned, 3> vertices :
                 {std::array{64u, 64u, 64u}, std::array{500u, 20u, 4u}, std::array{5u, 5u, 900u}}) {
                SCOPED_TRACE(testing::Message() << int(anatomy) << ' ' << picture.x << " x "
                                                << picture.y << ' ' << vertices[0]);
                index::SeriesInfo info;
                info.anatomy = anatomy;
                info.grid.vertices = vertices;
                const auto placement = filling(info, options, screen, head, picture);
                const render::View view =
                    view_of(screen, head, stereo::Eye::center, 0, 0.05f, 50, picture);
                glm::vec2 low(1e9f), high(-1e9f);
                for (unsigned corner = 0; corner < 8; ++corner) {
                    const glm::dvec3 at = glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2) *
                                          (glm::dvec3(vertices[0], vertices[1], vertices[2]) - 1.0);
                    const glm::vec4 clip =
                        view.clip_from_eye * view.eye_from_room *
                        glm::vec4(transform(placement, glm::dvec3(info.grid.physical_from_index() *
                                                                  glm::dvec4(at, 1))),
                                  1);
                    ASSERT_GT(clip.w, 0);
                    low = glm::min(low, glm::vec2(clip) / clip.w);
                    high = glm::max(high, glm::vec2(clip) / clip.w);
                }
                EXPECT_NEAR(std::max(high.x - low.x, high.y - low.y) / 2, 0.85, 0.01);
                EXPECT_NEAR(glm::length(low + high), 0, 0.01) << "in the middle";
                const glm::dvec3 up =
                    // Up in all placements, seen from a corner.
                    placement.rotation * glm::dvec3(0, 0, 1);
                EXPECT_GT(up.y, 0.7);
                EXPECT_GT(up.z, 0.4);
            }
}

} // namespace
} // namespace isochron::app
