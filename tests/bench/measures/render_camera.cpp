// Placement and frusta for the rendering benchmark.
#include "tests/bench/measures/render_camera.h"

#include "app/config/first_placement.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace isochron::bench {

namespace {

constexpr double kEyeSeparation = 0.063;       // meters
const glm::dvec3 kTowardsEye(0.45, 0.35, 1.0); // from the middle, along no axis

} // namespace

BenchCamera bench_camera(const index::SeriesInfo& info, int size, int eyes) {
    const glm::dmat4 room_from_physical = interaction::matrix(app::place(info));
    const glm::dmat4 physical_from_room = glm::inverse(room_from_physical);
    const glm::dvec3 center(room_from_physical * glm::dvec4(app::physical_center(info.grid), 1.0));
    const double radius = 0.5 * glm::length(app::physical_size(info.grid)) *
                          glm::length(glm::dvec3(room_from_physical[0]));
    const double slope = std::tan(glm::radians(0.5 * BenchCamera::kAngle));
    const double distance = radius / std::sin(glm::radians(0.5 * BenchCamera::kAngle));
    const double near = 0.5 * (distance - radius), far = distance + 2.0 * radius;
    const glm::dmat4 middle = glm::lookAt(center + distance * glm::normalize(kTowardsEye), center,
                                          glm::dvec3(0.0, 1.0, 0.0));

    BenchCamera camera{render::Placement::of(info.grid, room_from_physical), {}, {}};
    for (int eye = 0; eye < eyes; ++eye) {
        const double aside = eyes == 2 ? (eye - 0.5) * kEyeSeparation : 0.0;
        const double shift = -aside * near / distance;
        const glm::dmat4 eye_from_room =
            glm::translate(glm::dmat4(1.0), glm::dvec3(-aside, 0.0, 0.0)) * middle;
        camera.views.push_back(
            {.clip_from_eye = glm::mat4(glm::frustum(shift - slope * near, shift + slope * near,
                                                     -slope * near, slope * near, near, far)),
             .eye_from_room = glm::mat4(eye_from_room),
             .size = {size, size},
             .corner = {eye * size, 0}});
        const glm::dmat4 physical_from_eye = physical_from_room * glm::inverse(eye_from_room);
        camera.poses.push_back({glm::dvec3(physical_from_eye[3]),
                                glm::dvec3(physical_from_room * glm::dvec4(center, 1.0)),
                                glm::normalize(glm::dvec3(physical_from_eye[1]))});
    }
    return camera;
}

const std::vector<render::View>& SwayingViews::next() {
    constexpr float kShift = 1e-7f; // share of half a picture
    to_the_right_ = !to_the_right_;
    for (render::View& view : views_)
        view.clip_from_eye[2][0] += to_the_right_ ? kShift : -kShift;
    return views_;
}

} // namespace isochron::bench
