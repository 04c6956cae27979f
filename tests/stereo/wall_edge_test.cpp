// A thing that crosses from one wall to the next is seen at one point of their common edge.
#include "stereo/screen.h"
#include "tests/support/test_seed.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <random>

namespace isochron::stereo {
namespace {

using interaction::Pose;

constexpr float kSeparation = 0.065f;

struct Edge {
    const char* name;
    Screen first, second;
    glm::vec3 from, to; ///< the common edge
};

/// The edges of a cube of walls, 3 m each: front, left, right, floor.
std::vector<Edge> edges() {
    const auto wall = [](glm::vec3 lower_left, glm::vec3 upper_left, glm::vec3 upper_right) {
        return Screen{lower_left, upper_left, upper_right};
    };
    const Screen front = wall({-1.5, 0, -1.5}, {-1.5, 3, -1.5}, {1.5, 3, -1.5});
    const Screen left = wall({-1.5, 0, 1.5}, {-1.5, 3, 1.5}, {-1.5, 3, -1.5});
    const Screen right = wall({1.5, 0, -1.5}, {1.5, 3, -1.5}, {1.5, 3, 1.5});
    const Screen floor = wall({-1.5, 0, 1.5}, {-1.5, 0, -1.5}, {1.5, 0, -1.5});
    return {{"left, front", left, front, {-1.5, 0, -1.5}, {-1.5, 3, -1.5}},
            {"front, right", front, right, {1.5, 0, -1.5}, {1.5, 3, -1.5}},
            {"floor, front", floor, front, {-1.5, 0, -1.5}, {1.5, 0, -1.5}},
            {"left, floor", left, floor, {-1.5, 0, 1.5}, {-1.5, 0, -1.5}},
            {"floor, right", floor, right, {1.5, 0, -1.5}, {1.5, 0, 1.5}}};
}

/// The point of a wall, meters in the room, where a point of the room is seen.
glm::vec3 seen_on(const Screen& screen, const Pose& head, Eye eye, glm::vec3 point) {
    const render::View view = view_of(screen, head, eye, kSeparation, 0.05f, 50.0f, {1000, 1000});
    const glm::vec4 clip = view.clip_from_eye * view.eye_from_room * glm::vec4(point, 1.0f);
    const glm::vec2 place = 0.5f * glm::vec2(clip) / clip.w + 0.5f;
    return screen.lower_left + place.x * (screen.upper_right - screen.upper_left) +
           place.y * (screen.upper_left - screen.lower_left);
}

TEST(WallEdge, ALineThatCrossesItIsSeenAtOnePointFromBothWallsAndBothEyes) {
    std::mt19937 random(test_seed());
    const auto number = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    for (const Edge& edge : edges())
        for (int i = 0; i < 300; ++i) {
            const glm::quat turn = glm::normalize(
                glm::quat(number(0.5f, 1), number(-1, 1), number(-1, 1), number(-1, 1)));
            const Pose head{{number(-1, 1), number(0.5f, 2), number(-1, 1)}, turn};
            for (const Eye eye : {Eye::left, Eye::right}) {
                // Anywhere on the ray through a point of the edge, a line of the room crosses it.
                const glm::vec3 on_edge = glm::mix(edge.from, edge.to, number(0.02f, 0.98f));
                const glm::vec3 from = eye_position(head, eye, kSeparation);
                const glm::vec3 point = from + number(0.4f, 8.0f) * (on_edge - from);
                const glm::vec3 first = seen_on(edge.first, head, eye, point);
                const glm::vec3 second = seen_on(edge.second, head, eye, point);
                EXPECT_LT(glm::distance(first, on_edge), 1e-4f) << edge.name;
                EXPECT_LT(glm::distance(second, on_edge), 1e-4f) << edge.name;
            }
        }
}

} // namespace
} // namespace isochron::stereo
