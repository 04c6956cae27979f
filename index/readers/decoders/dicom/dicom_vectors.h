// Frames of older DICOM files: vectors with a number for each frame say what it is.
#pragma once

#include "index/readers/decoders/dicom/dicom_image.h"
#include "index/readers/decoders/dicom/dicom_tags.h"

#include <map>
#include <string>
#include <vector>

namespace isochron::index {

/// What the frames of an older file, which has no groups of frames, count.
struct FrameCounts {
    std::vector<double> levels; ///< [mm] along the normal; counted where no distance is said
    double first = 0;           ///< level of the slice whose position the file says
    std::vector<double> times;  ///< empty: all are of the same time
    bool timed = false;         ///< times are in ms, else counted
    std::map<std::string, std::vector<double>> volumes; ///< numbers, by what they count
};

/// @param file gets what its frames are ordered by
/// @throws Error naming the file: frames that are views, not slices
FrameCounts count_frames(const DicomTags& root, DicomFile& file, const std::string& name);

/// What vectors can count that makes volumes of their own: `detector`.
std::vector<std::string> counted_volumes();

} // namespace isochron::index
