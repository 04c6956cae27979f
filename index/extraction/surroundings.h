// How much of a surface's surroundings lies behind it, for shading that shows how deep a place
// lies.
#pragma once

#include "index/volume/query.h"
#include "index/volume/step_values.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// Shares of the volume around places at equal distances, for each of some surfaces. A renderer
/// asks for the share a little before the surface: it is small before a plane or a bump, and grows
/// as deep as the surface's place lies among other parts of it. Ambient occlusion in the sense of
/// local volumes: the share of a ball around the point (P. Shirley's obscurance, as S. Zhukov,
/// A. Iones and G. Kronin introduced it, Rendering Techniques 1998,
/// doi:10.1007/978-3-7091-6453-2_5, taken in the volume and not along rays). The same for every
/// view.
struct SurroundingField {
    std::array<std::uint32_t, 3> size{}; ///< places along x, y and z
    std::uint32_t stride = 1;            ///< voxels of the volume between places
    /// [surface][z][y][x], x fastest: 255 times the share that is at the isovalue or above.
    /// Empty: there is none.
    std::vector<std::uint8_t> shares;
};

/// Places along an axis, at most.
inline constexpr std::uint32_t kMostPlaces = 64;
/// How far the surroundings reach from a place along each axis, in places; what is near counts
/// more.
inline constexpr std::uint32_t kSurroundingsReach = 4;

/// @param values of the volume, or of a level of detail of it
/// @param level that it is: its vertices lie at every 2^level-th of the volume
SurroundingField surroundings_of(const StepValues& values, std::uint32_t step, unsigned level,
                                 std::span<const double> isovalues);

} // namespace isochron::index
