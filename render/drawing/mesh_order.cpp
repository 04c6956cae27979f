// Sorts triangles by the coordinate of their cells, by counting.
#include "render/drawing/mesh_order.h"

#include "index/surface/mesh_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace isochron::render {

PlaneOrder near_planes_first(const glm::vec4& eye, const glm::vec3& extent,
                             const glm::vec3& spacing) {
    PlaneOrder order;
    float most = -1.0f;
    for (int axis = 0; axis < 3; ++axis) {
        const float ahead = (eye[axis] - eye.w * 0.5f * extent[axis]) * spacing[axis];
        if (std::abs(ahead) > most) {
            most = std::abs(ahead);
            order = {axis, ahead > 0.0f};
        }
    }
    return order;
}

void append_in_order(std::span<const CellPlace> cells, const index::CellMesh& mesh,
                     PlaneOrder order, OrderedTriangles& triangles) {
    const std::array<std::uint16_t CellPlace::*, 3> coordinates{&CellPlace::x, &CellPlace::y,
                                                                &CellPlace::z};
    const auto coordinate = coordinates[static_cast<std::size_t>(order.axis)];
    std::uint32_t planes = 0;
    for (const CellPlace& cell : cells)
        planes = std::max(planes, cell.*coordinate + 1u);
    const std::array<index::MeshCase, 256>& cases = index::mesh_cases();
    std::vector<std::uint32_t> next(planes); ///< place of each plane's next triangle
    for (std::size_t i = 0; i < cells.size(); ++i)
        next[cells[i].*coordinate] += cases[mesh.cases[i]].triangles;
    const auto first = static_cast<std::uint32_t>(triangles.numbers.size());
    std::uint32_t before = first;
    for (std::uint32_t i = 0; i < planes; ++i) {
        std::uint32_t& plane = next[order.descending ? planes - 1 - i : i];
        before += std::exchange(plane, before);
    }
    triangles.numbers.resize(before);
    triangles.corners.resize(std::size_t{3} * before);
    std::uint32_t number = first;
    const std::uint32_t* from = mesh.triangles.data();
    for (std::size_t i = 0; i < cells.size(); ++i) {
        std::uint32_t& at = next[cells[i].*coordinate];
        const std::uint32_t count = cases[mesh.cases[i]].triangles;
        std::uint32_t* const to = triangles.corners.data() + std::size_t{3} * at;
        for (std::size_t k = 0; k < std::size_t{3} * count; ++k)
            to[k] = from[k];
        for (std::uint32_t k = 0; k < count; ++k)
            triangles.numbers[at + k] = number++;
        from += std::size_t{3} * count;
        at += count;
    }
}

} // namespace isochron::render
