// Views of the data along their axes.
#pragma once

#include "interaction/navigation/navigation.h"

#include <array>
#include <cstddef>

namespace isochron::interaction {

/// A direction to view the data from, in physical space.
struct AxisView {
    const char* name;       ///< `+x`, `isometric`
    glm::dvec3 towards_eye; ///< from the data to the viewer
    glm::dvec3 up;          ///< direction that points up in the view
};
/// The views from both ends of each axis, then the isometric one.
inline constexpr std::size_t kAxisViews = 7, kIsometric = 6;
const std::array<AxisView, kAxisViews>& axis_views();

/// Turns the data so that the viewer sees `view`, and moves them straight ahead of the viewer.
/// Distance and scale stay as they are.
/// @param center of the data, physical space
Similarity seen_from(const AxisView& view, const Similarity& from, const glm::dvec3& center,
                     const Pose& viewer);

/// Index of the axis view after the current one; the first if the data are in none of them.
std::size_t axis_view_after(const Similarity& from, const Pose& viewer);

} // namespace isochron::interaction
