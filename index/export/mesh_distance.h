// How far two meshes lie from each other, between bounds that are computed, not estimated.
#pragma once

#include "index/surface/triangle_distance.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace isochron::index {

/// Triangles over points that they share.
struct PlainMesh {
    std::vector<glm::dvec3> points;
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< numbers of points

    std::array<glm::dvec3, 3> corners(std::size_t triangle) const {
        const auto& [a, b, c] = triangles[triangle];
        return {points[a], points[b], points[c]};
    }
};

/// Finds the triangle of a mesh that is nearest to a point, in a tree of boxes.
class NearestTriangle {
  public:
    struct Found {
        std::uint32_t triangle = 0;
        double squared = std::numeric_limits<double>::infinity(); ///< distance
    };

    /// @param mesh has triangles, and outlives this
    explicit NearestTriangle(const PlainMesh& mesh);
    /// @param hint a triangle that may be near: the nearer, the less is looked at
    Found find(const glm::dvec3& point, std::uint32_t hint) const;
    const PlainMesh& mesh() const { return mesh_; }
    /// Distances below this are lost in the rounding of the coordinates.
    double rounding() const;

  private:
    struct Node {
        glm::dvec3 low, high;
        std::uint32_t
            first; ///< in `order_`; of an inner node its second child, the first one follows it
        std::uint32_t count; ///< 0: an inner node
    };

    void build(std::uint32_t first, std::uint32_t end, const std::vector<glm::dvec3>& middles);

    const PlainMesh& mesh_;
    std::vector<std::uint32_t> order_; ///< triangles, those of a leaf together
    std::vector<Node> nodes_;
};

struct DistanceWishes {
    double most =
        std::numeric_limits<double>::infinity(); ///< where points lie farther away is told
    double known = 0;      ///< a lower bound of the largest distance that is known before
    double negligible = 0; ///< an upper bound as low as this need not be near the lower one
};

/// The largest distance lies between both bounds, ends included.
struct FarthestPoint {
    double lower = 0;
    double upper = 0; ///< infinite where it is above the most
    /// Triangles with points that lie farther away than the most, and those nearest to such points.
    std::vector<std::uint32_t> beyond, nearest;
};

/// The largest distance of any point of the triangles from those of another mesh. The triangles are cut
/// up until the bounds differ by at most 5 % of the lower one: the distance from one triangle is convex,
/// so on a piece it is largest in a corner. The result is the same for any number of threads.
/// @param look called now and then, on the calling thread; may be empty
FarthestPoint farthest_from(const PlainMesh& mesh, const NearestTriangle& other,
                            const DistanceWishes& wishes,
                            const std::function<void(double)>& look = {});

} // namespace isochron::index
