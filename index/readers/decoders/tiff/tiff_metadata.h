// What the descriptions of TIFF files say of their pages: OME-XML, ImageJ's and tifffile's.
#pragma once

#include "index/volume/value_type.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
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
    glm::dvec2 field_of_view{
        0.0}; ///< of all pixels along x and y, in place of spacing; 0: not said
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

/// OME-XML. http://www.openmicroscopy.org/Schemas/Documentation/Generated/OME-2016-06/ome.html
/// @param samples of a pixel, which OME counts among the channels
/// @param array names one of several images, `Pos1`, `Image:1`, `Pos1/GFP`; else the first is read
/// @throws Error naming the file: damaged, without pixels, impossible sizes
TiffStack ome_stack(const std::string& description, std::uint32_t samples, const std::string& array,
                    const std::string& file);

/// Leaves out the frames without all of their planes, which a stopped run has not written.
/// @param is_there of a plane that is described
/// @throws Error naming the file: no frame has all of them
void keep_whole_frames(TiffStack& stack, const std::function<bool(const TiffPlane&)>& is_there,
                       const std::string& file);

/// Name of the file that has the OME-XML of this file; empty if the file has its own.
std::string ome_metadata_file(const std::string& description);

/// ImageJ's lines of `key=value`: calibration, places and units as ImageJ shows them.
/// @param pages that have directories
/// @throws Error naming the file: counts that are no numbers
TiffStack imagej_stack(const std::string& description, std::size_t pages, double x_resolution,
                       double y_resolution, const std::string& file);

/// Reads OME-XML, ImageJ's or ScanImage's lines, told by how the description begins; in other
/// descriptions pages are slices, or have tifffile's `shape`.
/// @param array names one of several images
/// @throws Error naming the file, as above
TiffStack stack_of(const std::string& description, std::size_t pages, std::uint32_t samples,
                   double x_resolution, double y_resolution, const std::string& array,
                   const std::string& file);

} // namespace isochron::index
