// The share of the volume around a place that lies inside a surface, for ambient occlusion: it
// darkens crevices.
#pragma once

#include "index/volume/query.h"
#include "index/volume/step_values.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {

/// For each surface, a coarse grid of places, and at each the share of the volume around it that is
/// at the isovalue or above. A renderer looks it up a little in front of the surface: the share is
/// small in front of a plane or a bump, and larger the deeper the point lies in a crevice. This is
/// ambient occlusion by local volumes: the share of a ball around the point (as the obscurances of
/// S. Zhukov, A. Iones and G. Kronin, Rendering Techniques 1998,
/// doi:10.1007/978-3-7091-6453-2_5, but in the volume and not along rays). The same for every
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

/// Some planes of vertices, from the first to before the end.
struct PlaneRange {
    std::uint32_t first = 0, end = 0;
};
/// Makes anew what a change of some planes has changed: the same as `surroundings_of` then.
/// @param field of the volume before the change, at the same level and isovalues
/// @param changed planes of `values`; none: nothing has changed
void renew_surroundings(SurroundingField& field, const StepValues& values, std::uint32_t step,
                        std::span<const double> isovalues, PlaneRange changed);

} // namespace isochron::index
