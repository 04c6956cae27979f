// What the descriptions of TIFF files say of their pages: OME-XML, ImageJ's and tifffile's.
#pragma once

#include "index/readers/decoders/tiff/tiff_stack.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace isochron::index {

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
