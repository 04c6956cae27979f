// The hyperstack that pages of TIFF files make, whoever describes it.
#pragma once

#include "index/readers/formats/stated/stated_array.h"
#include "index/volume/value_type.h"

#include <glm/vec2.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace isochron::index {

/// Where the page of a channel, slice and frame is.
struct TiffPlane {
    std::string file; ///< its name, where it is in another; empty: this one
    std::size_t page = 0;
    bool there = false;
};

/// The hyperstack that pages make.
struct TiffStack {
    std::size_t channels = 1, slices = 1, frames = 1;
    std::vector<std::string> channel_names = {};
    std::array<StatedAxis, 3> axes{}; ///< x, y and z: spacing, origin and unit
    StatedAxis time{.name = "time"};  ///< times of the frames
    glm::dvec2 field_of_view{0.0};    ///< extent of all pixels along x and y; 0: not said
    Scaling scaling = {};
    std::string value_unit = {};
    /// Channel fastest, then slice, then frame; empty: in this order.
    std::vector<TiffPlane> planes = {};
    bool appended = false; ///< pages may follow the first without directories
    /// Names of the images of a file that has several, and the one of these that is described.
    std::vector<std::string> images = {};
    std::size_t image = 0;
    std::vector<std::string> notes = {};
};

/// States the distance between neighbors along an axis, if it is one.
inline void set_spacing(StatedAxis& axis, double spacing, const std::string& unit) {
    if (!(spacing > 0) || !std::isfinite(spacing))
        return;
    axis.step = spacing;
    axis.unit = unit;
    axis.regular = true;
}

} // namespace isochron::index
