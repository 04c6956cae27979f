// Puts images at the same place in the order of their times.
#pragma once

#include "index/readers/decoders/dicom/dicom_image.h"

#include <string>
#include <vector>

namespace isochron::index {

using DicomSlice = std::vector<DicomImage>; ///< images at one place

/// Times of steps.
struct DicomTimes {
    std::vector<double> times = {}; ///< empty: not said
    std::string unit = {};
    std::vector<std::string> notes = {}; ///< the last says by what the steps are ordered
};

/// Sorts the images of each slice by what tells them apart.
/// @param names of the files
/// @throws Error naming files: other numbers of images at other places, images that nothing tells
///         apart
DicomTimes sort_times(std::vector<DicomSlice>& slices, const DicomFile& file,
                      const std::vector<std::string>& names);

} // namespace isochron::index
