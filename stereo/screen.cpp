// Computes frusta from screen corners and eye positions.
#include "stereo/screen.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace isochron::stereo {
namespace {

/// A screen as its middle, unit axes (right, up, towards the viewer) and half sizes. In doubles, so
/// that corners are exact for large screens and near eyes.
struct Plane {
    glm::dvec3 middle, right, up, normal;
    double half_width, half_height;
};

Plane plane_of(const Screen& screen) {
    const glm::dvec3 across = glm::dvec3(screen.upper_right) - glm::dvec3(screen.upper_left);
    const glm::dvec3 upwards = glm::dvec3(screen.upper_left) - glm::dvec3(screen.lower_left);
    const glm::dvec3 right = glm::normalize(across);
    const glm::dvec3 up = glm::normalize(upwards);
    return {0.5 * (glm::dvec3(screen.lower_left) + glm::dvec3(screen.upper_right)),
            right,
            up,
            glm::normalize(glm::cross(right, up)),
            0.5 * glm::length(across),
            0.5 * glm::length(upwards)};
}

Screen in_room(Screen screen, const interaction::Pose& head) {
    if (screen.carried_by_head)
        for (glm::vec3* corner : {&screen.lower_left, &screen.upper_left, &screen.upper_right})
            *corner = head.position + head.orientation * *corner;
    return screen;
}

/// The screen in the room for a head's pose, fitted to a picture of this size.
Plane plane_in_room(const Screen& screen, const interaction::Pose& head, glm::ivec2 pixels) {
    Plane plane = plane_of(in_room(screen, head));
    const double share = 1.0 - static_cast<double>(screen.aside); // the screen's own
    if (screen.fit_aspect) {
        const double aspect = share * static_cast<double>(pixels.x) / std::max(pixels.y, 1);
        if (plane.half_width < plane.half_height * aspect)
            plane.half_width = plane.half_height * aspect;
        else
            plane.half_height = plane.half_width / aspect;
    }
    const double whole = plane.half_width / share;
    plane.middle -= (whole - plane.half_width) * plane.right;
    plane.half_width = whole;
    return plane;
}

/// Moves a position in front of the plane, at least `kNearestEye` away.
glm::dvec3 in_front(const Plane& plane, glm::dvec3 position) {
    const double distance = glm::dot(position - plane.middle, plane.normal);
    return distance < kNearestEye ? position + (kNearestEye - distance) * plane.normal : position;
}

/// Enlarges the plane to the part of the room that it shows at this distance from the head.
Plane widened(Plane plane, const interaction::Pose& head, float distance) {
    const glm::dvec3 eyes = in_front(plane, head.position);
    const double away = glm::dot(eyes - plane.middle, plane.normal), wider = distance / away;
    const glm::dvec3 foot = eyes - away * plane.normal; // what is straight ahead stays there
    plane.middle = foot + wider * (plane.middle - foot);
    plane.half_width *= wider;
    plane.half_height *= wider;
    return plane;
}

/// A point from which all lines of sight are nearly parallel.
glm::dvec3 far_from(const Plane& plane) {
    return plane.middle + static_cast<double>(kFarEye) * plane.normal;
}

render::View view_from(const glm::dvec3& position, const Plane& plane, float near_plane,
                       float far_plane, glm::ivec2 pixels) {
    const double distance = glm::dot(position - plane.middle, plane.normal);
    const glm::dvec3 to_middle = plane.middle - position;
    const double x = glm::dot(to_middle, plane.right), y = glm::dot(to_middle, plane.up);
    const double scale = near_plane / distance;
    const glm::dmat4 clip_from_eye =
        glm::frustum(scale * (x - plane.half_width), scale * (x + plane.half_width),
                     scale * (y - plane.half_height), scale * (y + plane.half_height),
                     static_cast<double>(near_plane), static_cast<double>(far_plane));
    const glm::dmat4 room_from_axes(glm::dvec4(plane.right, 0.0), glm::dvec4(plane.up, 0.0),
                                    glm::dvec4(plane.normal, 0.0), glm::dvec4(0, 0, 0, 1));
    const glm::dmat4 eye_from_room = glm::translate(glm::transpose(room_from_axes), -position);
    return {glm::mat4(clip_from_eye), glm::mat4(eye_from_room), pixels};
}

/// The ray from a position through a place in the plane.
interaction::Pose ray_from(const glm::dvec3& position, const glm::dvec3& place,
                           const Plane& plane) {
    const glm::dvec3 back = glm::normalize(position - place);
    const glm::dvec3 right = glm::normalize(glm::cross(plane.up, back));
    const glm::dquat turn = glm::quat_cast(glm::dmat3(right, glm::cross(back, right), back));
    return {glm::vec3(position), glm::normalize(glm::quat(turn))};
}

glm::dvec3 place_on(const Plane& plane, glm::vec2 at) {
    return plane.middle + (2.0 * at.x - 1.0) * plane.half_width * plane.right +
           (2.0 * at.y - 1.0) * plane.half_height * plane.up;
}

bool finite(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

} // namespace

glm::vec3 eye_position(const interaction::Pose& head, Eye eye, const Eyes& eyes) {
    const float side = eye == Eye::left ? -0.5f : eye == Eye::right ? 0.5f : 0.0f;
    return head.position + head.orientation * (eyes.middle + side * eyes.separation * eyes.across);
}

render::View view_of(const Screen& screen, const interaction::Pose& head, Eye eye, const Eyes& eyes,
                     float near_plane, float far_plane, glm::ivec2 pixels) {
    const Plane plane = plane_in_room(screen, head, pixels);
    return view_from(in_front(plane, eye_position(head, eye, eyes)), plane, near_plane, far_plane,
                     pixels);
}

render::View parallel_view_of(const Screen& screen, const interaction::Pose& head, float distance,
                              float far_plane, glm::ivec2 pixels) {
    const Plane plane = widened(plane_in_room(screen, head, pixels), head, distance);
    return view_from(far_from(plane), plane, kFarEye - std::min(far_plane, 0.9f * kFarEye),
                     kFarEye + far_plane, pixels);
}

std::array<glm::vec3, 4> corners_in_room(const Screen& screen, const interaction::Pose& head,
                                         glm::ivec2 pixels) {
    const Plane plane = plane_in_room(screen, head, pixels);
    const glm::dvec3 across = plane.half_width * plane.right;
    const glm::dvec3 upwards = plane.half_height * plane.up;
    return {glm::vec3(plane.middle - across - upwards), glm::vec3(plane.middle - across + upwards),
            glm::vec3(plane.middle + across + upwards), glm::vec3(plane.middle + across - upwards)};
}

interaction::Pose ray_through(const Screen& screen, const interaction::Pose& head, Eye eye,
                              const Eyes& eyes, glm::ivec2 pixels, glm::vec2 at) {
    const Plane plane = plane_in_room(screen, head, pixels);
    return ray_from(in_front(plane, eye_position(head, eye, eyes)), place_on(plane, at), plane);
}

interaction::Pose parallel_ray_through(const Screen& screen, const interaction::Pose& head,
                                       float distance, glm::ivec2 pixels, glm::vec2 at) {
    const Plane plane = widened(plane_in_room(screen, head, pixels), head, distance);
    const glm::dvec3 place = place_on(plane, at);
    const glm::dvec3 way = glm::normalize(far_from(plane) - place);
    const glm::dvec3 eyes = in_front(plane, head.position);
    const double away = glm::dot(eyes - plane.middle, plane.normal);
    return ray_from(place + away * way, place, plane);
}

glm::vec2 size_of(const Screen& screen) {
    return {glm::distance(screen.upper_left, screen.upper_right),
            glm::distance(screen.lower_left, screen.upper_left)};
}

double corner_angle(const Screen& screen) {
    const Plane plane = plane_of(screen);
    return glm::degrees(std::acos(std::clamp(-glm::dot(plane.right, plane.up), -1.0, 1.0)));
}

bool faces(const Screen& screen, glm::vec3 viewer) {
    const Plane plane = plane_of(screen);
    return glm::dot(glm::dvec3(viewer) - plane.middle, plane.normal) > 0.0;
}

float distance_to(const Screen& screen, const interaction::Pose& head) {
    const Plane plane = plane_of(in_room(screen, head));
    return static_cast<float>(
        std::abs(glm::dot(glm::dvec3(head.position) - plane.middle, plane.normal)));
}

float vertical_field_of_view(const Screen& screen, const interaction::Pose& head) {
    constexpr float kNearest = 0.1f; // meters: nearer heads do not widen the angle
    const float distance = std::max(distance_to(screen, head), kNearest);
    return 2.0f * std::atan(0.5f * size_of(screen).y / distance);
}

std::vector<std::string> problems(const Screen& screen, glm::vec3 viewer) {
    for (const glm::vec3& corner : {screen.lower_left, screen.upper_left, screen.upper_right})
        if (!finite(corner))
            return {"a corner is not a number"};
    const glm::vec2 size = size_of(screen);
    if (!(size.x > 1e-4f) || !(size.y > 1e-4f))
        return {fmt::format("it is {:.3g} x {:.3g} m in size: two of its corners are the same",
                            size.x, size.y)};

    std::vector<std::string> found;
    const double angle = corner_angle(screen);
    if (std::abs(angle - 90.0) > kSquareCorner)
        found.push_back(
            fmt::format("the corner at upper_left has {:.1f} degrees, expected 90", angle));
    if (std::abs(angle - 90.0) > 87.0)
        return found; // the corners are on one line: it has no front
    if (screen.carried_by_head)
        viewer = glm::vec3(0.0f);
    if (!faces(screen, viewer))
        found.push_back(fmt::format("it is mirrored: {} ({:g} {:g} {:g}) sees it from behind, "
                                    "with left and right exchanged",
                                    screen.carried_by_head ? "the head" : "a viewer at", viewer.x,
                                    viewer.y, viewer.z));
    if (plane_of(screen).up.y < -0.5)
        found.push_back("it is upside down: upper_left is below lower_left, as the viewer sees "
                        "them; for a display that hangs upside down give the corners that the "
                        "viewer sees, and upside_down = true in its viewport");
    return found;
}

} // namespace isochron::stereo
