// The clip box: along the axes of the grid, what is outside it is cut away.
#pragma once

#include "interaction/tools/tool.h"

#include <optional>
#include <vector>

namespace isochron::interaction {

/// All planes that cut the surfaces: the clip plane, and the faces of the clip box, if they are
/// shown. Each has `shown` set.
std::vector<ClipPlane> cutting_planes(const Settings& settings, const DataFrame& data);

/// The box around all of the data, shown.
ClipBox whole_box(const DataFrame& data);

struct BoxFace {
    int axis = 0;
    bool high = false; ///< the face at the box's upper end of the axis
};
/// The face of the box that a ray meets first.
std::optional<BoxFace> face_met(const ClipBox& box, const Pose& ray, const ToolContext& now);
/// The plane of a face; its normal points out of the box.
Plane plane_of(const BoxFace& face, const ClipBox& box, const DataFrame& data);
/// The box with a face moved to where a plane lies, across the same axis: within the data, and a
/// hundredth of a cell at least from the face on the other side.
ClipBox with_face(ClipBox box, const BoxFace& face, const Plane& plane, const DataFrame& data);

/// Its edges.
ToolDrawing draw_clip_box(const Settings& settings, const DataFrame& data);

} // namespace isochron::interaction
