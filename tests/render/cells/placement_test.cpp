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

} // namespace
} // namespace isochron::render
