// Random single cells, seen by random cameras: parallel, perspective and strongly off-axis.
#pragma once

#include "render/cells/placement.h"
#include "render/gl/view.h"

#include <glm/gtc/matrix_transform.hpp>

#include <random>

namespace isochron::render {

struct Scene {
    View view;
    Placement placement;
    glm::ivec3 cell{0};
    double radius = 1.0; ///< radius of the footprint [voxels]

    glm::dmat4 pixel_from_index() const {
        const glm::dmat4 pixel =
            glm::scale(glm::dmat4(1.0), glm::dvec3(0.5 * view.size.x, 0.5 * view.size.y, 1.0));
        return pixel * glm::dmat4(view.clip_from_eye) * glm::dmat4(view.eye_from_room) *
               glm::dmat4(placement.room_from_index);
    }
    /// From the eye to the cell's center [voxels].
    double eye_distance() const {
        const glm::dvec4 eye =
            glm::inverse(glm::dmat4(view.eye_from_room) * glm::dmat4(placement.room_from_index))[3];
        return glm::distance(glm::dvec3(eye), glm::dvec3(cell) + 0.5);
    }
    /// Smallest distance from the eye's plane over the ellipsoid, in eye space.
    double nearest() const {
        const glm::dmat4 m = glm::dmat4(view.eye_from_room) * glm::dmat4(placement.room_from_index);
        const glm::dvec4 row(m[0][2], m[1][2], m[2][2], m[3][2]);
        return -glm::dot(row, glm::dvec4(glm::dvec3(cell) + 0.5, 1.0)) -
               radius * glm::length(glm::dvec3(row));
    }
};

/// A cell near the middle of the view, in a volume of spacing up to 1:1:10, rotated anyhow and
/// mirrored half of the time; its ellipsoid lies between the near and far planes. One camera in
/// three is parallel; the others look through a window far off the axis.
inline Scene random_scene(std::mt19937& random, glm::ivec2 size = {200, 160}, double radius = 2.0) {
    auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (;;) {
        Scene scene;
        scene.radius = radius;
        scene.view.size = size;
        scene.cell = glm::ivec3(uniform(0, 40), uniform(0, 40), uniform(0, 40));
        glm::dvec3 spacing(uniform(1, 2), uniform(1, 2), uniform(1, 2));
        spacing[static_cast<int>(random() % 3)] *= uniform(1, 10);
        if (random() % 2)
            spacing.x = -spacing.x;
        const glm::dvec3 axis(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
        const double size_in_room = uniform(0.01, 0.05) / glm::length(spacing);
        glm::dmat4 m = glm::rotate(glm::dmat4(1.0), uniform(0, 6.28), axis);
        m = glm::scale(m, spacing * size_in_room);
        const glm::dvec3 place(uniform(-0.3, 0.3), uniform(1.0, 1.6), uniform(-0.6, -0.2));
        m = m * glm::translate(glm::dmat4(1.0), -(glm::dvec3(scene.cell) + 0.5));
        scene.placement.room_from_index = glm::mat4(glm::translate(glm::dmat4(1.0), place) * m);
        scene.placement.extent = glm::vec3(41.0f);
        const glm::vec3 eye(uniform(-0.2, 0.2), uniform(1.1, 1.5), uniform(0.0, 0.3));
        scene.view.eye_from_room =
            glm::rotate(glm::mat4(1.0f), float(uniform(-0.3, 0.3)), glm::vec3(0.2f, 1.0f, 0.1f)) *
            glm::translate(glm::mat4(1.0f), -eye);
        // The window is placed around the cell, wherever that is: far off the axis, mostly.
        const glm::dvec4 at = glm::dmat4(scene.view.eye_from_room) * glm::dvec4(place, 1.0);
        const double aspect = double(size.x) / size.y;
        const double near = 0.02, half = uniform(0.3, 1.2) * near;
        const double x = -at.x / at.z * near + uniform(-0.5, 0.5) * half * aspect;
        const double y = -at.y / at.z * near + uniform(-0.5, 0.5) * half;
        if (random() % 3 == 0)
            scene.view.clip_from_eye = glm::mat4(glm::ortho(
                at.x - 0.3 * aspect, at.x + 0.2 * aspect, at.y - 0.2, at.y + 0.3, near, 5.0));
        else
            scene.view.clip_from_eye = glm::mat4(
                glm::frustum(x - half * aspect, x + half * aspect, y - half, y + half, near, 5.0));
        if (scene.nearest() > 1.5 * near)
            return scene;
    }
}

} // namespace isochron::render
