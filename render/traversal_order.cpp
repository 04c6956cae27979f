// The order as three stable counting sorts over an axis permutation.
#include "render/traversal_order.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace isochron::render {

namespace {

std::uint32_t coordinate(const index::CellPoint& point, std::uint8_t axis) {
    return axis == 0 ? point.x : axis == 1 ? point.y : point.z;
}

/// Position of a slice in the order along one axis: from below up to the eye's slice, from above
/// down to it, and the eye's slice last.
std::uint32_t rank_of(int slice, int eye, int slices) {
    if (slice < eye)
        return slice;
    return std::max(eye, 0) + (slices - 1 - slice);
}

/// Stably sorts `from` into `to` by the rank along one axis.
void counting_sort(std::span<const index::CellPoint> points, std::uint8_t axis, int eye, int slices,
                   std::span<const std::uint32_t> from, std::span<std::uint32_t> to) {
    std::vector<std::uint32_t> rank(slices), begin(slices + 1, 0);
    for (int slice = 0; slice < slices; ++slice)
        rank[slice] = rank_of(slice, eye, slices);
    for (const index::CellPoint& point : points)
        ++begin[rank[coordinate(point, axis)] + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    for (const std::uint32_t cell : from)
        to[begin[rank[coordinate(points[cell], axis)]]++] = cell;
}

} // namespace

TraversalKey traversal_key(const glm::vec4& eye, const glm::ivec3& cells) {
    TraversalKey key;
    glm::vec3 away;
    for (int axis = 0; axis < 3; ++axis) {
        const float extent = static_cast<float>(cells[axis]);
        if (eye.w != 0.0f) {
            key.eye_cell[axis] = static_cast<int>(std::floor(std::clamp(eye[axis], -1.0f, extent)));
            away[axis] = std::abs(eye[axis] - 0.5f * extent);
        } else {
            key.eye_cell[axis] = eye[axis] < 0.0f ? -1 : cells[axis];
            away[axis] = std::abs(eye[axis]);
        }
    }
    std::stable_sort(key.axes.begin(), key.axes.end(),
                     [&](std::uint8_t a, std::uint8_t b) { return away[a] > away[b]; });
    return key;
}

void order_back_to_front(std::span<const index::CellPoint> points, const TraversalKey& key,
                         const glm::ivec3& cells, std::vector<std::uint32_t>& order) {
    order.resize(points.size());
    std::iota(order.begin(), order.end(), 0u);
    std::vector<std::uint32_t> sorted(points.size());
    for (auto axis = key.axes.rbegin(); axis != key.axes.rend(); ++axis) {
        counting_sort(points, *axis, key.eye_cell[*axis], cells[*axis], order, sorted);
        order.swap(sorted);
    }
}

} // namespace isochron::render
