// The hyperstack that pages of TIFF files make, whoever describes it.
#pragma once

#include "index/volume/value_type.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

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
    glm::dvec3 spacing{1.0}, origin{0.0};
    glm::dvec2 field_of_view{0.0}; ///< extent of all pixels along x and y; 0: not said
    Scaling scaling = {};
    std::string value_unit = {};
    std::vector<double> times = {}; ///< times of frames, where they are said one by one
    std::string length_unit = {}, time_unit = {};
    double time_step = 0; ///< 0: not said
    /// Channel fastest, then slice, then frame; empty: in this order.
    std::vector<TiffPlane> planes = {};
    bool appended = false; ///< pages may follow the first without directories
    /// Names of the images of a file that has several, and the one of these that is described.
    std::vector<std::string> images = {};
    std::size_t image = 0;
    std::vector<std::string> notes = {};
};

} // namespace isochron::index
