// What is refused of viewers, windows, viewports and screens.
#include "app/config/config_checks.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>

namespace isochron::app {
namespace {

constexpr float kFarthestEye = 0.5f; ///< [m] from the head's origin
constexpr float kThinnest = 1e-3f;   ///< [m] a narrower screen is a mistake

} // namespace

void check(const TomlTable& at, const Config&, stereo::Screen& screen) {
    // If some corners are given, all must be: a missing one must not keep its default.
    const std::array kCorners{"lower_left", "upper_left", "upper_right"};
    const bool given = std::ranges::any_of(kCorners, [&](auto corner) { return at.has(corner); });
    for (const char* corner : kCorners)
        if (given && !at.has(corner))
            at.fail(corner, "missing, a screen is given by three corners");
    const float width = glm::length(screen.upper_right - screen.upper_left);
    const float height = glm::length(screen.upper_left - screen.lower_left);
    if (width < kThinnest || height < kThinnest)
        at.fail("lower_left", fmt::format("the screen is {} m wide and {} m high", width, height));
    const glm::vec3 across = (screen.upper_right - screen.upper_left) / width;
    const glm::vec3 upwards = (screen.upper_left - screen.lower_left) / height;
    if (glm::length(glm::cross(across, upwards)) < kThinnest)
        at.fail("upper_right", "the three corners lie on one line");
}

void check(const TomlTable& at, const Config&, stereo::Viewport& viewport) {
    for (int axis = 0; axis < 2; ++axis)
        if (viewport.position[axis] < 0 || viewport.size[axis] <= 0 ||
            viewport.position[axis] + viewport.size[axis] > 1.0001f)
            at.fail("size",
                    "the viewport leaves its window (position and size are fractions, 0 to 1)");
    if (viewport.screen.line.number == 0)
        viewport.screen.line.number = at.line();
}

void check(const TomlTable& at, const Config&, stereo::Window& window) {
    for (stereo::Viewport& viewport : window.viewports)
        if (viewport.screen.line.number == 0)
            viewport.screen.line.number = at.line();
}

/// Measured places of the eyes; what is written of one eye alone, or beside `eye_separation`, is a
/// mistake.
void check(const TomlTable& at, const Config&, stereo::Viewer& viewer) {
    if (viewer.head.empty())
        at.fail("head", "expected the name of the device that tracks the head");
    if (!viewer.left_eye && !viewer.right_eye)
        return;
    if (!viewer.left_eye || !viewer.right_eye)
        at.fail(viewer.left_eye ? "right_eye" : "left_eye", "missing, both eyes are given or none");
    if (at.has("eye_separation"))
        at.fail("eye_separation", "left_eye and right_eye say how far apart the eyes are");
    const glm::vec3 left = *viewer.left_eye, right = *viewer.right_eye;
    for (const auto& [key, eye] : {std::pair("left_eye", left), std::pair("right_eye", right)})
        if (!(glm::length(eye) <= kFarthestEye))
            at.fail(key, fmt::format("the eye is {:.4g} m from the head, expected at most {:g}: "
                                     "meters in the frame of the head (x right, y up, z back)",
                                     glm::length(eye), kFarthestEye));
    viewer.eye_separation = glm::length(right - left);
    if (!(viewer.eye_separation <= interaction::kWidestEyes))
        at.fail("right_eye", fmt::format("the eyes are {:.4g} m apart, expected at most {:g}",
                                         viewer.eye_separation, interaction::kWidestEyes));
    if (left.x > right.x)
        at.fail("left_eye", "the left eye is right of the right one: x points to the right");
}

} // namespace isochron::app
