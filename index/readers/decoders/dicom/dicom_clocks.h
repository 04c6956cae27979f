// When DICOM images were taken: each statement of it, with its unit.
#pragma once

#include "index/readers/decoders/dicom/dicom_image.h"
#include "index/readers/decoders/dicom/dicom_tags.h"

#include <string>
#include <string_view>
#include <vector>

namespace isochron::index {

/// What its values are in: `ms`; empty: it counts. Those in seconds are of a calendar, or of a day.
std::string_view unit_of(DicomClock clock);

/// The name of the attribute, as in the standard: `TriggerTime`.
std::string name_of(DicomClock clock, const DicomFile& file);

/// Sets the clocks that attributes of a frame, or of the file, are.
void read_clocks(const FrameTags& tags, DicomImage& image);

/// The attributes that are clocks.
std::vector<gdcm::Tag> tags_of_clocks();

} // namespace isochron::index
