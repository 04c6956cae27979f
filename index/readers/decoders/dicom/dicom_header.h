// What the headers of DICOM files say of their images.
#pragma once

#include "index/readers/decoders/dicom/dicom_image.h"

#include <cstddef>
#include <filesystem>

namespace isochron::index {

/// @param number of the file in its list
/// @throws Error naming the file: no DICOM, damaged, pixels that are no scalars or colors, a mosaic
///         or frames whose places cannot be told
DicomFile read_dicom_header(const std::filesystem::path& path, std::size_t number);

} // namespace isochron::index
