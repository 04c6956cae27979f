// A plane that cuts a surface and the cells around it: what lies on one side of it.
#pragma once

#include "index/volume/grid.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// In physical space.
struct CutPlane {
    glm::dvec3 point{0.0};            ///< on it
    glm::dvec3 normal{0.0, 0.0, 1.0}; ///< points to the side that is cut away; not 0
    bool operator==(const CutPlane&) const = default;
};

/// Distances from a plane, in lengths of its normal, as places in a grid have them. What is not above
/// 0 is left.
class PlaneCut {
  public:
    PlaneCut(const CutPlane& plane, const Grid& grid);

    /// @param at distances along the grid's axes from its first vertex (Grid::distance)
    double beyond(const glm::dvec3& at) const {
        return start_ + along_.x * at.x + along_.y * at.y + along_.z * at.z;
    }
    /// @param at in physical space, less the grid's origin
    double beyond_physical(const glm::dvec3& at) const;
    /// Whether triangles in the plane are left: they are if it cuts away one of its sides, and not if
    /// it cuts away the other.
    bool leaves_plane() const;
    const glm::dvec3& along() const { return along_; }

  private:
    glm::dvec3 normal_, along_; ///< in physical space; by how much it grows along each axis
    double start_;              ///< at the grid's first vertex
};

/// What a plane leaves of a surface.
struct CutSurface {
    std::vector<glm::dvec3> points;      ///< those of the surface, then those on cut sides
    std::vector<float> values;           ///< values at the points, if the surface has some
    std::vector<std::uint32_t> corners;  ///< three for each triangle
    std::uint64_t vertices = 0;          ///< points that triangles have
    std::vector<std::uint8_t> triangles; ///< number of those left of each cell that has some
};

/// Cuts triangles. @param beyond of each point @param triangles number of each cell's
/// @param leaves_plane triangles in the plane
CutSurface cut(std::span<const glm::dvec3> points, std::span<const float> values,
               std::span<const std::uint32_t> corners, std::span<const double> beyond,
               std::span<const std::uint8_t> triangles, bool leaves_plane);

/// A plane in a cell whose sides are 1 long: `start + along * place`.
struct CellCut {
    double start;
    std::array<double, 3> along;

    double beyond(const std::array<double, 3>& at) const {
        return start + along[0] * at[0] + along[1] * at[1] + along[2] * at[2];
    }
    /// Whether the whole cell is left, and whether nothing of it is.
    bool leaves_all() const;
    bool leaves_nothing() const;
};

/// The flow of (beyond / along[axis], 0, 0), with `axis` in place of x, through what is left of a
/// flat polygon: through the plane itself there is none, so these sum up to the volume of what
/// it leaves of a body. @param polygon its corners, counter-clockwise as seen from outside
double flow_through(std::span<const std::array<double, 3>> polygon, const CellCut& plane,
                    std::size_t axis);

} // namespace isochron::index
