// Ticks, numbers and titles along the edges of the volume's box.
#pragma once

#include "index/volume/volume_series.h"
#include "interaction/pose.h"
#include "render/cells/placement.h"
#include "render/passes/line_pass.h"
#include "render/passes/text_pass.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// What runs along one edge: physical coordinates where the edge is parallel to a physical axis,
/// else the distance from the first vertex.
struct AxisScale {
    std::string title;        ///< `x [mm]`; an oblique axis has its index letter: `i [mm]`
    double low = 0, high = 0; ///< at the axis' first and last vertex
};
AxisScale axis_scale(const index::SeriesInfo& info, int axis);

/// One of the four edges along an axis: the sides (false: at 0, true: at the far end) of the two
/// other axes, `(axis + 1) % 3` first.
using EdgeSides = std::array<bool, 2>;

/// The edge that carries an axis' numbers: of those at the outline of the box, where a face that
/// faces the viewer meets one that does not, the one lowest and, less so, furthest left as the
/// viewer holds the head. Hence it is the same for both eyes, and nothing of the box hides it.
/// Nothing when the viewer is inside the box.
std::optional<EdgeSides> labeled_edge(int axis, const render::Placement& placement,
                                      const interaction::Pose& head);

/// What is written along one edge, in vertex index coordinates.
struct AxisLabels {
    struct Number {
        render::Label label;
        std::int64_t multiple; ///< of the step between ticks
    };
    render::Label title;
    std::vector<Number> numbers; ///< ascending
};

/// In vertex index coordinates. Not all labels have room in every view: see axis_labels.h.
struct Axes {
    std::vector<render::Line> ticks;
    std::vector<AxisLabels> labels; ///< of each axis that has an edge to carry them
};
Axes axes_for(const index::SeriesInfo& info, const render::Placement& placement,
              const interaction::Pose& head);

} // namespace isochron::app
