// Series that are the phases of one scan: a 4D CT has a series for each.
#pragma once

#include "index/readers/decoders/dicom/dicom_stack.h"

#include <cstddef>
#include <string>
#include <vector>

namespace isochron::index {

/// Puts a volume in front of these in which those that are phases follow each other, if some are.
/// Such series say the part of a breath or a heartbeat in words (`Gated 20%`, `phase 3`), or by
/// `NominalPercentageOfCardiacPhase` and the like, or their number among all of them
/// (`TemporalPositionIdentifier`), and have images at the same places.
/// @param names of the files: words may also be those of their folders
/// @return the number of phases; 0: there are none
std::size_t join_phases(std::vector<DicomVolume>& volumes, const std::vector<DicomFile>& files,
                        const std::vector<std::string>& names);

} // namespace isochron::index
