// Bounds of boxes by interval arithmetic.
#include "render/culling/box_projection.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <limits>

namespace isochron::render {

namespace {

constexpr float kLarger = 1.01f;   ///< times the box, for what its rays may find beside it
constexpr float kPixels = 0.0625f; ///< added on all sides
constexpr float kNearer = 4e-6f;   ///< taken off window depths
/// Share of the w of its middle, for a box that is not near the eye.
constexpr float kLeastShare = 0.1f;

/// The most by which a row changes from the middle of a box to its surface.
float reach(const glm::vec3& row, const glm::vec3& half) {
    return glm::dot(glm::abs(row), half);
}

} // namespace

BoxProjection::BoxProjection(const View& view, const Placement& placement)
    : size_(view.size), center_(0.5f * size_) {
    const glm::mat4 rows =
        glm::transpose(view.clip_from_eye * view.eye_from_room * placement.room_from_index);
    x_ = center_.x * rows[0];
    y_ = center_.y * rows[1];
    w_ = rows[3];
    const glm::vec3 along(w_);
    const float length2 = glm::dot(along, along);
    slope_ = length2 > 0.0f ? glm::dot(glm::vec3(rows[2]), along) / length2 : 0.0f;
    rest_ = rows[2] - slope_ * w_;
}

std::optional<BoxBounds> BoxProjection::bounds(const glm::vec3& middle,
                                               const glm::vec3& half) const {
    const glm::vec4 at(middle, 1.0f);
    const glm::vec3 box = kLarger * half;
    const float w = glm::dot(w_, at), deep = reach(glm::vec3(w_), box);
    if (w + deep <= 0.0f)
        return std::nullopt;
    const float least = w - deep, most = w + deep;
    if (least <= kLeastShare * w)
        return BoxBounds{glm::vec2(0.0f), size_, -std::numeric_limits<float>::infinity()};
    const float over_w = 1.0f / w, over_least = 1.0f / least;
    const glm::vec2 seen = over_w * glm::vec2(glm::dot(x_, at), glm::dot(y_, at));
    const glm::vec2 around = over_least * glm::vec2(reach(glm::vec3(x_ - seen.x * w_), box),
                                                    reach(glm::vec3(y_ - seen.y * w_), box)) +
                             kPixels;
    const glm::vec2 low = center_ + seen - around, high = center_ + seen + around;
    if (high.x < 0.0f || high.y < 0.0f || low.x > size_.x || low.y > size_.y)
        return std::nullopt;
    const float rest = glm::dot(rest_, at) - reach(glm::vec3(rest_), box);
    const float depth = slope_ + rest * (rest < 0.0f ? over_least : 1.0f / most);
    return BoxBounds{low, high, 0.5f + 0.5f * depth - kNearer};
}

} // namespace isochron::render
