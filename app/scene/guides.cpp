// The grid on the floor, and the target of a teleport.
#include "app/scene/guides.h"

#include <cmath>

namespace isochron::app {
namespace {

constexpr glm::vec4 kFloorColor(0.36f, 0.42f, 0.50f, 0.6f);
constexpr glm::vec4 kTargetColor(0.47f, 0.86f, 0.63f, 0.9f);
constexpr int kHalfFloor = 5; ///< [m] from the origin to an edge
constexpr float kRing = 0.2f; ///< [m] radius
constexpr int kCorners = 24;  ///< number of the ring's corners
constexpr float kTwoPi = 6.28318531f;

void add_floor(std::vector<render::Line>& lines) {
    constexpr auto kEdge = static_cast<float>(kHalfFloor);
    for (int i = -kHalfFloor; i <= kHalfFloor; ++i) {
        const auto at = static_cast<float>(i);
        lines.push_back({{at, 0, -kEdge}, {at, 0, kEdge}, kFloorColor});
        lines.push_back({{-kEdge, 0, at}, {kEdge, 0, at}, kFloorColor});
    }
}

void add_target(const glm::vec3& center, std::vector<render::Line>& lines) {
    const auto corner = [&](int i) {
        const float angle = kTwoPi * static_cast<float>(i) / kCorners;
        return center + kRing * glm::vec3(std::cos(angle), 0, std::sin(angle));
    };
    for (int i = 0; i < kCorners; ++i)
        lines.push_back({corner(i), corner(i + 1), kTargetColor});
    for (const glm::vec3 arm : {glm::vec3(kRing, 0, 0), glm::vec3(0, 0, kRing)})
        lines.push_back({center - arm, center + arm, kTargetColor});
}

} // namespace

std::vector<render::Line> lines_of(const Guides& guides) {
    std::vector<render::Line> lines;
    if (guides.floor)
        add_floor(lines);
    if (guides.target)
        add_target(glm::vec3(*guides.target), lines);
    return lines;
}

} // namespace isochron::app
