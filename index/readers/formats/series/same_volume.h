// Whether the volumes of two files can be steps of one series.
#pragma once

#include "index/volume/volume_series.h"

#include <string>

namespace isochron::index {

/// Compares vertices, array, type, spacing, origin, direction and scaling, with a tolerance: geometry as
/// decimal text or f32 differs in its last digits. @throws Error naming both files
void expect_same(const SeriesInfo& got, const std::string& file, const SeriesInfo& first,
                 const std::string& first_file);

} // namespace isochron::index
