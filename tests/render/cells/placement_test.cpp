// The places of a grid's cells in the room.
#include "render/cells/placement.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

namespace isochron::render {
namespace {

TEST(Placement, FarOriginsLoseNoPrecision) {
    index::Grid grid{.vertices = {11, 21, 31}, .origin = {1e7, -2e7, 3e7}, .spacing = {1, 2, 3}};
    const glm::dmat4 room_from_physical = glm::scale(glm::dmat4(1.0), glm::dvec3(0.01)) *
                                          glm::translate(glm::dmat4(1.0), -grid.origin);
    const Placement placement = Placement::of(grid, room_from_physical);
    const glm::vec4 at = placement.room_from_index * glm::vec4(10, 20, 30, 1);
    EXPECT_NEAR(at.x, 0.1f, 1e-6f);
    EXPECT_NEAR(at.y, 0.4f, 1e-6f);
    EXPECT_NEAR(at.z, 0.9f, 1e-6f);
    EXPECT_EQ(placement.extent, glm::vec3(10, 20, 30));
    EXPECT_NEAR(placement.room_from_physical[2][2], 0.01f, 1e-9f);
}

TEST(Placement, NormalsStayAtRightAnglesWhereHeightsAreExaggerated) {
    const index::Grid grid{.vertices = {11, 21, 31}};
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), 0.7, glm::dvec3(0.3, 0.5, 0.8));
    const glm::vec3 normal(1, 2, 3), in_plane(2, -1, 0), steep = glm::cross(normal, in_plane);
    for (const double higher : {1.0, 5.0}) {
        const Placement placement =
            Placement::of(grid, glm::scale(turn, 0.01 * glm::dvec3(1, 1, higher)));
        const glm::vec3 shown = glm::normalize(placement.room_from_normal() * normal);
        for (const glm::vec3& v : {in_plane, steep})
            EXPECT_NEAR(glm::dot(shown, placement.room_from_physical * v), 0, 1e-6) << higher;
    }
    // For a similarity it is the matrix itself.
    const Placement placement = Placement::of(grid, turn);
    EXPECT_EQ(placement.room_from_normal(), placement.room_from_physical);
}

} // namespace
} // namespace isochron::render
