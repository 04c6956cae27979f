// Puts the images of DICOM files in the order of their places and times.
#pragma once

#include "index/readers/decoders/dicom/dicom_image.h"
#include "index/volume/grid.h"

#include <string>
#include <vector>

namespace isochron::index {

/// The images of a volume, and where and when they are.
struct DicomStack {
    Grid grid;
    bool in_space = false;                      ///< positions are said: in mm, LPS
    std::vector<std::vector<DicomImage>> steps; ///< each from its first slice to its last
    std::vector<double> times = {};             ///< times of the steps; empty: not said
    std::string time_unit = {};
    std::vector<std::string> notes = {};
};

/// A choice of volumes that the images of several files make.
struct DicomVolume {
    std::string name; ///< `CT`; where there are several, what tells it apart: `3 thorax`
    std::vector<DicomImage> images;
};

/// Images that differ in series, size, directions, echo and the like belong to several volumes.
std::vector<DicomVolume> dicom_volumes(const std::vector<DicomFile>& files);

/// @param images of one volume @param first the file that holds the first of them
/// @param names of the files
/// @param spaced whether a user says how far slices are apart: frames of one slice may be slices then
/// @throws Error naming a file: slices shifted sideways (a tilted gantry), missing slices, images
///         at the same place that nothing tells apart, a film
DicomStack dicom_stack(const std::vector<DicomImage>& images, const DicomFile& first,
                       const std::vector<std::string>& names, bool spaced);

} // namespace isochron::index
