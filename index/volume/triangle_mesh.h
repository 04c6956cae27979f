// Triangles in physical space that stand beside the surfaces: those of a file, or of another step.
#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace isochron::index {

struct TriangleMesh {
    glm::dvec3 origin{0.0};         ///< physical space
    std::vector<glm::vec3> points;  ///< physical space, less `origin`
    std::vector<glm::vec3> normals; ///< one a point, of any length; 0: none. Empty: none has one
    std::vector<std::uint32_t> corners; ///< three points a triangle

    std::size_t triangles() const { return corners.size() / 3; }
};
using TriangleMeshPtr = std::shared_ptr<const TriangleMesh>;

/// The lowest and the highest coordinates of a mesh with points, physical space.
inline std::array<glm::dvec3, 2> bounds(const TriangleMesh& mesh) {
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (const glm::vec3& point : mesh.points) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    return {mesh.origin + glm::dvec3(low), mesh.origin + glm::dvec3(high)};
}

} // namespace isochron::index
