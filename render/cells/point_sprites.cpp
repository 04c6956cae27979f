// Bounds on the footprints of all cells that a volume could have.
#include "render/cells/point_sprites.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace isochron::render {

namespace {

/// Most uneven spacing: beyond it the square around an ellipse is mostly empty.
constexpr float kMostUneven = 2.0f;
/// Largest difference [pixels] on each side between a square and the rectangle that it replaces, at
/// the corners of the volume. Inside the volume it is smaller, apart from the curvature of z^3/2.
constexpr float kSquareError = 0.75f;

bool nearly_even(const glm::vec3& spacing) {
    const auto [low, high] = std::minmax({spacing.x, spacing.y, spacing.z});
    return high <= kMostUneven * low;
}

} // namespace

bool points_serve(const View& view, const Placement& placement, float radius, float reach,
                  float largest_point) {
    if (placement.rectilinear || !nearly_even(placement.spacing()))
        return false;
    const glm::mat4 clip_from_index =
        view.clip_from_eye * view.eye_from_room * placement.room_from_index;
    // The frustum is convex: if the corners of a box are inside, the whole box is.
    const glm::vec3 low(0.5f - reach * radius);
    const glm::vec3 high = placement.extent - low;
    float nearest = std::numeric_limits<float>::max();
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 at =
            glm::mix(low, high, glm::vec3(corner & 1, corner >> 1 & 1, corner >> 2));
        const glm::vec4 p = clip_from_index * glm::vec4(at, 1.0f);
        if (p.w <= 0.0f || std::abs(p.x) > p.w || std::abs(p.y) > p.w)
            return false;
        nearest = std::min(nearest, p.w);
    }
    // Bounds of the terms in cell.vert, for the nearest cell in any direction of the view.
    const auto row = [&](int i) {
        return glm::length(
            glm::vec3(clip_from_index[0][i], clip_from_index[1][i], clip_from_index[2][i]));
    };
    const float tilt = row(3);
    const float distance = nearest + reach * radius * tilt;
    const float d = distance * distance - radius * radius * tilt * tilt;
    if (d <= kLeastDepth * distance * distance)
        return false;
    const float k = radius * radius / d;
    const glm::vec2 sides = 0.5f * glm::vec2(view.size) * glm::vec2(row(0) + tilt, row(1) + tilt);
    const float half_size =
        std::numbers::sqrt2_v<float> * glm::length(sides) * std::sqrt(k * (1.0f + k * tilt * tilt));
    return 2.0f * half_size <= largest_point;
}

bool footprints_are_squares(const View& view, const Placement& placement, float radius) {
    // How far voxels are from cubes in the room: for rotated cubes the transpose times the matrix
    // would be a multiple of the identity.
    const glm::mat3 axes(view.eye_from_room * placement.room_from_index);
    const glm::mat3 square = glm::transpose(axes) * axes;
    const float voxel2 = (square[0][0] + square[1][1] + square[2][2]) / 3.0f;
    float uneven = 0.0f; // bound of the difference between 1 and the ratio of squared half axes
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            uneven += std::abs(square[i][j] / voxel2 - (i == j ? 1.0f : 0.0f));

    const bool parallel = view.is_parallel();
    const glm::vec2 scale =
        0.5f * glm::vec2(view.size) * glm::vec2(view.clip_from_eye[0][0], view.clip_from_eye[1][1]);
    const auto [narrow, wide] = std::minmax({std::abs(scale.x), std::abs(scale.y)});
    uneven += wide * wide / (narrow * narrow) - 1.0f;

    const float sphere2 = radius * radius * voxel2;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 at(
            view.eye_from_room * placement.room_from_index *
            glm::vec4(placement.extent * glm::vec3(corner & 1, corner >> 1 & 1, corner >> 2),
                      1.0f));
        const float z2 = at.z * at.z;
        if (!parallel && (at.z > 0.0f || z2 <= 2.0f * sphere2))
            return false;
        // Half axes in pixels: c and c / cos, with c = f r / sqrt(z^2 - r^2).
        const float half = wide * std::sqrt(parallel ? sphere2 : sphere2 / (z2 - sphere2));
        const float over_cos2 = parallel ? 1.0f : 1.0f + (at.x * at.x + at.y * at.y) / z2;
        if (half * (std::sqrt(over_cos2 * (1.0f + uneven)) - 1.0f) > kSquareError)
            return false;
    }
    return true;
}

} // namespace isochron::render
