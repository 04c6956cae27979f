// Decides what each image of a DICOM file stands for: a place, a time, or a volume of its own.
#pragma once

#include "index/readers/decoders/dicom/dicom_image.h"
#include "index/readers/decoders/dicom/dicom_tags.h"

#include <cstddef>
#include <string>
#include <vector>

namespace isochron::index {

/// The images of a file, whether it has one, counts its frames by vectors (older objects), groups
/// what it says of each frame (enhanced ones) or is a mosaic of slices. Sets what `file` says of
/// their order.
/// @param root of a file whose pixels are known
/// @throws Error naming the file: frames that are no slices (projections, tiles of a picture), or
///         that are described wrongly
std::vector<DicomImage> images_of(const DicomTags& root, DicomFile& file, std::size_t number,
                                  const std::string& name);

} // namespace isochron::index
