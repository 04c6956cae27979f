// The camera of the rendering benchmark: 45 degrees, and the volume's bounding sphere just fits
// into the picture.
#pragma once

#include "index/volume/volume_series.h"
#include "render/cells/placement.h"
#include "render/gl/view.h"

#include <glm/vec3.hpp>

#include <vector>

namespace isochron::bench {

/// Pose of a camera in the physical space of the series.
struct CameraPose {
    glm::dvec3 eye, center, up;
};

struct BenchCamera {
    static constexpr double kAngle = 45.0; ///< degrees, of the whole picture
    render::Placement placement;
    std::vector<render::View> views; ///< left to right, side by side
    std::vector<CameraPose> poses;   ///< one for each view
};

/// @param size of both sides of each eye's picture, pixels
/// @param eyes 1 or 2; two are as far apart as a person's, with zero parallax in the volume's
/// middle
BenchCamera bench_camera(const index::SeriesInfo& info, int size, int eyes);

/// Views that differ from each other by much less than a pixel from draw to draw: what is found for
/// a view is found anew, as under a tracked head, and the picture stays the same.
class SwayingViews {
  public:
    explicit SwayingViews(std::vector<render::View> views) : views_(std::move(views)) {}
    const std::vector<render::View>& next();

  private:
    std::vector<render::View> views_;
    bool to_the_right_ = false;
};

} // namespace isochron::bench
