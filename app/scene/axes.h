// Ticks, numbers and titles along the edges of the volume's box.
#pragma once

#include "index/volume/volume_series.h"
#include "interaction/pose.h"
#include "render/cells/placement.h"
#include "render/gl/view.h"
#include "render/passes/line_pass.h"
#include "render/passes/text_pass.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::app {

/// The scale along one edge: physical coordinates if the edge is parallel to a physical axis, else
/// the distance from the first vertex.
struct AxisScale {
    /// `x [mm]`, or as the file calls the axis, `longitude (degrees)`; an oblique axis has its
    /// index letter: `i [mm]`.
    std::string title;
    double low = 0, high = 0; ///< values at the axis' first and last vertex
};
AxisScale axis_scale(const index::SeriesInfo& info, int axis);

/// One of the four edges along an axis, by its side (false: at 0, true: at the far end) on each of
/// the two other axes, `(axis + 1) % 3` first.
using EdgeSides = std::array<bool, 2>;

/// The edge that carries an axis' numbers. Candidates lie on the outline of the box, where a face
/// towards the viewer meets one that faces away, so that the box does not hide them. Of these it is
/// the lowest and, with less weight, leftmost one for the viewer's head, so it is the same for both
/// eyes. Empty if the viewer is inside the box.
std::optional<EdgeSides> labeled_edge(int axis, const render::Placement& placement,
                                      const interaction::Pose& head);

/// The texts along one edge, in vertex index coordinates.
struct AxisLabels {
    struct Number {
        render::Label label;
        std::int64_t multiple; ///< the number, in steps between ticks
    };
    render::Label title;
    std::vector<Number> numbers; ///< ascending
};

/// Ticks and labels of all axes, in vertex index coordinates. Not all labels have room in every
/// view: see axis_labels.h.
struct Axes {
    std::vector<render::Line> ticks;
    std::vector<AxisLabels> labels; ///< labels of each axis that has a labeled edge
};
/// @param views that show them all: where they show a part of an axis, it has at least two numbers and
/// its title there; empty: they show all
Axes axes_for(const index::SeriesInfo& info, const render::Placement& placement,
              const interaction::Pose& head, std::span<const render::View> views = {});

} // namespace isochron::app
