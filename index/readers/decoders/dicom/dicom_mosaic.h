// Slices that lie side by side in one picture, as Siemens and United Imaging store a volume.
#pragma once

#include "index/readers/decoders/dicom/dicom_image.h"
#include "index/readers/decoders/dicom/dicom_tags.h"

#include <string>

namespace isochron::index {

/// What a mosaic of United Imaging says of each slice, as an enhanced file of each frame.
inline const gdcm::Tag kTileGroups(0x0065, 0x1051);

/// Makes the slices of a mosaic the frames of its file: sets their number and size and the way from
/// one to the next. What images are is decided after it.
/// @throws Error naming the file: a mosaic that does not say how many slices it has
void take_mosaic(const DicomTags& root, const std::string& name, DicomFile& file);

} // namespace isochron::index
