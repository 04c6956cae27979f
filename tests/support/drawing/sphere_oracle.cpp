// Tests the line of sight through each pixel.
#include "tests/support/drawing/sphere_oracle.h"

#include "stereo/stereo_mode.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace isochron::test_support {

PinholeEye::PinholeEye(const stereo::Screen& screen, const interaction::Pose& head, stereo::Eye eye,
                       double eye_separation, glm::ivec2 picture)
    : eye_(head.position), upper_left_(screen.upper_left),
      across_(glm::dvec3(screen.upper_right - screen.upper_left) / double(picture.x)),
      down_(glm::dvec3(screen.lower_left - screen.upper_left) / double(picture.y)),
      picture_(picture) {
    const glm::dvec3 right(head.orientation * glm::vec3(1, 0, 0));
    if (eye != stereo::Eye::center)
        eye_ += (eye == stereo::Eye::left ? -0.5 : 0.5) * eye_separation * right;
}

bool PinholeEye::sees(glm::dvec2 pixel, glm::dvec3 center, double radius) const {
    const glm::dvec3 along =
        glm::normalize(upper_left_ + pixel.x * across_ + pixel.y * down_ - eye_);
    const glm::dvec3 to_center = center - eye_;
    return glm::dot(to_center, along) > 0.0 && glm::length(glm::cross(to_center, along)) < radius;
}

std::optional<glm::dvec2> PinholeEye::pixel_of(glm::dvec3 point) const {
    constexpr double kNearest = 0.1; // meters
    const glm::dmat3 room_from_pixels(across_, down_, upper_left_ - eye_);
    const glm::dvec3 at = glm::inverse(room_from_pixels) * (point - eye_);
    const double screen_distance =
        std::abs(glm::dot(upper_left_ - eye_, glm::normalize(glm::cross(across_, down_))));
    if (at.z * screen_distance < kNearest)
        return std::nullopt;
    const glm::dvec2 pixel = glm::dvec2(at) / at.z;
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= picture_.x || pixel.y >= picture_.y)
        return std::nullopt;
    return pixel;
}

Coverage coverage(glm::ivec2 picture, const std::function<bool(int, int)>& covered) {
    Coverage found;
    glm::dvec2 sum(0.0);
    for (int y = 0; y < picture.y; ++y) {
        int first = 0, last = picture.x - 1;
        while (first <= last && !covered(first, y))
            ++first;
        while (last > first && !covered(last, y))
            --last;
        const double pixels = last - first + 1;
        found.pixels += pixels;
        sum += pixels * glm::dvec2(0.5 * (first + last + 1), y + 0.5);
    }
    found.center = sum / std::max(found.pixels, 1.0);
    return found;
}

Coverage expected_coverage(const PinholeEye& eye, glm::dvec3 center, double radius) {
    return coverage(eye.picture(),
                    [&](int x, int y) { return eye.sees({x + 0.5, y + 0.5}, center, radius); });
}

std::vector<glm::dvec3> points_on_edges(double extent, int per_edge) {
    std::vector<glm::dvec3> points;
    for (int axis = 0; axis < 3; ++axis)
        for (int edge = 0; edge < 4; ++edge)
            for (int i = 0; i < per_edge; ++i) {
                glm::dvec3 point;
                point[axis] = extent * i / (per_edge - 1);
                point[(axis + 1) % 3] = edge & 1 ? extent : 0.0;
                point[(axis + 2) % 3] = edge & 2 ? extent : 0.0;
                points.push_back(point);
            }
    return points;
}

} // namespace isochron::test_support
