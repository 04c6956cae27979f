// Sorts triangles, and keeps the last orders on the GPU.
#include "render/drawing/far_orders.h"

#include "render/drawing/mesh_order.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace isochron::render {
namespace {

constexpr float kDirections = 32;      ///< parts of 1 to which directions are rounded
constexpr std::size_t kMostOrders = 8; ///< that are kept
constexpr std::size_t kMostCorners = 1u
                                     << 24; ///< in all orders that are kept, but for the last one

/// Corners of the triangles beyond a distance, then those of the others.
std::vector<std::uint32_t> far_half_first(const std::vector<float>& distances, float middle,
                                          const std::vector<std::uint32_t>& corners) {
    std::vector<std::uint32_t> ordered;
    ordered.reserve(corners.size());
    for (const bool beyond : {true, false})
        for (std::size_t i = 0; i < distances.size(); ++i)
            if ((distances[i] > middle) == beyond)
                ordered.insert(ordered.end(), &corners[3 * i], &corners[3 * i] + 3);
    return ordered;
}

} // namespace

glm::vec3 rounded_direction(const glm::mat4& eye_from_index) {
    const glm::mat4& eye = eye_from_index;
    return glm::round(-kDirections * glm::normalize(glm::vec3(eye[0].z, eye[1].z, eye[2].z)));
}

const FarOrders::Order& FarOrders::along(const glm::vec3& ahead, float middle, std::size_t most,
                                         const Measure& measure) {
    const auto known = std::ranges::find(orders_, ahead, &Order::ahead);
    if (known != orders_.end())
        return *known;
    std::vector<float> distances;
    std::vector<std::uint32_t> corners;
    measure(distances, corners);
    const auto beyond =
        std::ranges::count_if(distances, [&](float distance) { return distance > middle; });
    const std::vector<std::uint32_t> ordered = distances.size() > most
                                                   ? far_half_first(distances, middle, corners)
                                                   : far_first(distances, corners);
    const std::size_t kept = std::clamp<std::size_t>(
        kMostCorners / std::max<std::size_t>(ordered.size(), 1), 1, kMostOrders);
    while (orders_.size() >= kept)
        orders_.pop_front();
    Order& order = orders_.emplace_back(
        Order{ahead, Buffer(*gl_), 3 * static_cast<std::size_t>(beyond), ordered.size()});
    gl_->NamedBufferData(order.corners.name(),
                         static_cast<GLsizeiptr>(ordered.size() * sizeof(std::uint32_t)),
                         ordered.data(), GL_STREAM_DRAW);
    return order;
}

} // namespace isochron::render
