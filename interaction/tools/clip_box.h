// The clip box: along the axes of the grid, what is outside it is cut away.
#pragma once

#include "interaction/tools/tool.h"

#include <vector>

namespace isochron::interaction {

/// All planes that cut the surfaces: the clip plane, and the faces of the clip box, if they are
/// shown. Each has `shown` set.
std::vector<ClipPlane> cutting_planes(const Settings& settings, const DataFrame& data);

/// The box around all of the data, shown.
ClipBox whole_box(const DataFrame& data);

/// Its edges.
ToolDrawing draw_clip_box(const Settings& settings, const DataFrame& data);

} // namespace isochron::interaction
