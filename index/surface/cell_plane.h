// The plane that approximates the surface in a cell, packed in 32 bits.
#pragma once

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace isochron::index {

/// A plane near the middle of a cell. Its normal is the normal used for shading. It lies where the
/// linear function with the mean and the mean slope of the cell's eight values reaches the isovalue
/// on the way from the cell's middle along that normal.
struct CellPlane {
    glm::dvec3 normal{0.0}; ///< unit vector in physical space towards lower values; zero if none
    /// Distance from the cell's middle along the plane's normal in index space, which also points
    /// towards lower values; -kFarthest to kFarthest [voxels].
    double offset = 0.0;

    /// A little more than the distance of the cell's corners.
    static constexpr double kFarthest = 0.87;
    /// Where the squared cosine between the cell's own slope and the normal is less than this, the
    /// plane gets no offset.
    static constexpr double kLeastCosine2 = 1e-6;
};

/// Bits 0 to 11 and 12 to 23: the normal's x and y on the octahedron |x| + |y| + |z| = 1 with its
/// lower half folded outwards (Meyer and others 2010, doi:10.1111/j.1467-8659.2010.01737.x). -1 is
/// stored as 1, 0 as 2048 and 1 as 4095; all bits 0 is no normal. Bits 24 to 31: the offset as a
/// signed byte, 127 for kFarthest.
namespace packed_plane {
/// Code of 0 and steps to 1, for a coordinate on the octahedron.
constexpr int kZero = 2048, kOne = 2047;
constexpr int kFarthest = 127; ///< code of the farthest offset
} // namespace packed_plane

constexpr std::uint32_t kNormalBits = 0xffffff;

inline std::uint32_t pack(const CellPlane& plane) {
    const auto byte = static_cast<std::int32_t>(std::lround(
        std::clamp(plane.offset / CellPlane::kFarthest, -1.0, 1.0) * packed_plane::kFarthest));
    const glm::dvec3& n = plane.normal;
    const double sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    if (!(sum > 0))
        return 0;
    double u = n.x / sum, v = n.y / sum;
    if (n.z < 0) {
        const double folded = (1 - std::abs(v)) * (u < 0 ? -1 : 1);
        v = (1 - std::abs(u)) * (v < 0 ? -1 : 1);
        u = folded;
    }
    const auto coordinate = [](double c) {
        return static_cast<std::uint32_t>(std::lround(c * packed_plane::kOne) +
                                          packed_plane::kZero);
    };
    return coordinate(u) | coordinate(v) << 12 | static_cast<std::uint32_t>(byte) << 24;
}

/// The unit vector of a point on the octahedron.
inline glm::dvec3 unfolded(double u, double v) {
    glm::dvec3 n(u, v, 1 - std::abs(u) - std::abs(v));
    const double fold = std::max(-n.z, 0.0);
    n.x -= n.x < 0 ? -fold : fold;
    n.y -= n.y < 0 ? -fold : fold;
    return n / std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
}

inline CellPlane unpack_plane(std::uint32_t word) {
    const double offset =
        CellPlane::kFarthest * (static_cast<std::int32_t>(word) >> 24) / packed_plane::kFarthest;
    if ((word & kNormalBits) == 0)
        return {glm::dvec3(0.0), offset};
    const auto coordinate = [&](unsigned shift) {
        return (static_cast<int>(word >> shift & 0xfffu) - packed_plane::kZero) /
               double{packed_plane::kOne};
    };
    return {unfolded(coordinate(0), coordinate(12)), offset};
}

} // namespace isochron::index
