// Where a volume stands in the room at first.
#pragma once

#include "index/volume/volume_series.h"
#include "interaction/control_context.h"
#include "interaction/pose.h"
#include "stereo/installation.h"

namespace isochron::app {

/// The longest physical side becomes `size` meters; the center is `height` meters high and
/// `distance` meters ahead of a viewer at the room's origin.
struct PlacementOptions {
    double size = 1.5, height = 1.3, distance = 1.5;
    /// Share of a desktop window's picture that the data fill at first, seen from a corner; 0: they
    /// stand as the others say.
    double fill = 0;
};

/// Plain data keep their axes (x right, y up, z towards the viewer). Anatomical data stand with the
/// head up and face the viewer, so the patient's left is on the viewer's right. Data of the
/// Earth have the sky above and are seen from the south. If only the edge of a flat slab would be
/// seen, it is then turned until its broad side is: a lying one is seen from above. Never mirrors.
interaction::Similarity place(const index::SeriesInfo& info, const PlacementOptions& options = {});

/// Seen from a corner and from above, straight ahead of the viewer at `options.distance`, and so
/// large that the data's box fills the share `options.fill` of the picture's width or height.
/// @param screen that the viewer's head carries @param picture its size, pixels
interaction::Similarity filling(const index::SeriesInfo& info, const PlacementOptions& options,
                                const stereo::Screen& screen, const interaction::Pose& head,
                                glm::ivec2 picture);

/// Distance between the first and the last vertex along each index axis, in physical units.
glm::dvec3 physical_size(const index::Grid& grid);

/// Center of the volume in physical space.
glm::dvec3 physical_center(const index::Grid& grid);

/// The box of the data, for tools.
/// @param info outlives what is returned
interaction::DataFrame data_frame(const index::SeriesInfo& info);

} // namespace isochron::app
