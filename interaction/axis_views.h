// Views of the data along their axes.
#pragma once

#include "interaction/navigation.h"

#include <array>
#include <cstddef>
#include <optional>

namespace isochron::interaction {

/// From where the data are seen, in physical space.
struct AxisView {
    const char* name;       ///< `+x`, `isometric`
    glm::dvec3 towards_eye; ///< from the data to who sees them
    glm::dvec3 up;          ///< what points up then
};
/// From both ends of each axis, then the isometric one.
inline constexpr std::size_t kAxisViews = 7, kIsometric = 6;
const std::array<AxisView, kAxisViews>& axis_views();

/// The data turned so that they are seen so, in the middle of what the viewer sees, as far away and
/// as large as they are.
/// @param center of the data, physical space
Similarity seen_from(const AxisView& view, const Similarity& from, const glm::dvec3& center,
                     const Pose& viewer);

/// The axis view after the one in which the data are seen; the first where they are in none.
std::size_t axis_view_after(const Similarity& from, const Pose& viewer);

} // namespace isochron::interaction
