// Moves the planes of a coarse level's cells to where the volume's surface is.
#include "index/surface/coarse_planes.h"

#include "index/file/chunks/chunk_grid.h"
#include "index/surface/cell_plane.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace isochron::index {
namespace {

constexpr float kOfBend = 1.0f / 6.0f;
constexpr float kFarthestMove = 0.25f; ///< [voxels]

/// A normal in index space, and how normals differ along each axis.
struct Bend {
    glm::vec3 normal{0.0f}, differ{0.0f};
    std::array<std::uint8_t, 3> beside{}; ///< cells along each axis that it is known from
};

/// The order of cells, as a number.
std::uint64_t order_of(const CellPoint& point) {
    return std::uint64_t{point.z} << 32 | std::uint64_t{point.y} << 16 | point.x;
}

std::uint16_t along(const CellPoint& point, int axis) {
    return axis == 0 ? point.x : axis == 1 ? point.y : point.z;
}

void compare_along(std::span<const CellPoint> points, int axis, std::vector<Bend>& bends) {
    const auto a = static_cast<std::size_t>(axis);
    for (std::size_t i = 0, next = 0; i < points.size(); ++i) {
        if (along(points[i], axis) % kChunkEdge == kChunkEdge - 1)
            continue; // the cell beside it is in another chunk
        const std::uint64_t wanted = order_of(points[i]) + (std::uint64_t{1} << 16 * axis);
        while (next < points.size() && order_of(points[next]) < wanted)
            ++next;
        if (next == points.size())
            break;
        if (order_of(points[next]) != wanted || bends[i].normal == glm::vec3(0.0f) ||
            bends[next].normal == glm::vec3(0.0f))
            continue;
        const float differ = bends[next].normal[axis] - bends[i].normal[axis];
        for (Bend* const bend : {&bends[i], &bends[next]}) {
            bend->differ[axis] += differ;
            ++bend->beside[a];
        }
    }
}

} // namespace

void move_planes_out(std::span<CellPoint> points, const glm::dvec3& spacing) {
    std::vector<Bend> bends(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        if (const glm::vec3 normal(spacing * unpack_plane(points[i].plane).normal);
            normal != glm::vec3(0.0f))
            bends[i].normal = glm::normalize(normal);
    for (int axis = 0; axis < 3; ++axis)
        compare_along(points, axis, bends);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (bends[i].normal == glm::vec3(0.0f))
            continue;
        float bend = 0.0f;
        for (int axis = 0; axis < 3; ++axis)
            if (const int beside = bends[i].beside[static_cast<std::size_t>(axis)]; beside > 0)
                bend += bends[i].differ[axis] / static_cast<float>(beside);
        CellPlane plane = unpack_plane(points[i].plane);
        plane.offset += std::clamp(kOfBend * bend, -kFarthestMove, kFarthestMove);
        points[i].plane = pack(plane);
    }
}

} // namespace isochron::index
