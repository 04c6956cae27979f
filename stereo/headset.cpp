// Views of a headset's eyes.
#include "stereo/headset.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace isochron::stereo {
namespace {

/// Largest angle of a frustum's edge [rad]: near 90 degrees the edge is at infinity.
constexpr float kWidest = 1.55f;

} // namespace

bool is_drawable(const HeadsetEye& eye) {
    const FieldOfView& fov = eye.fov;
    bool within = true;
    for (const float angle : {fov.left, fov.right, fov.up, fov.down})
        within = within && std::abs(angle) < kWidest; // false for NaN
    return within && fov.left < fov.right && fov.down < fov.up && is_finite(eye.pose) &&
           std::abs(glm::length(eye.pose.orientation) - 1.0f) < 0.01f && eye.pixels.x > 0 &&
           eye.pixels.y > 0;
}

render::View view_of(const HeadsetEye& eye, float near_plane, float far_plane) {
    const double n = near_plane;
    const glm::dmat4 clip_from_eye = glm::frustum(
        n * std::tan(double(eye.fov.left)), n * std::tan(double(eye.fov.right)),
        n * std::tan(double(eye.fov.down)), n * std::tan(double(eye.fov.up)), n, double(far_plane));
    const glm::dmat4 eye_from_room =
        glm::translate(glm::dmat4(glm::mat4_cast(glm::conjugate(glm::dquat(eye.pose.orientation)))),
                       -glm::dvec3(eye.pose.position));
    return {glm::mat4(clip_from_eye), glm::mat4(eye_from_room), eye.pixels};
}

} // namespace isochron::stereo
