// Gaps of a series: between which steps nothing is to be blended unless somebody asks for it.
#pragma once

#include "index/volume/volume_series.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace isochron::index {

/// The steps, ascending, behind which a series has a gap: the next one is more than three times the
/// median distance away, or steps are missing there by the names of the files.
/// @param steps that count, the first ones of the series; 0: all
std::vector<std::uint32_t> gaps_of(const SeriesInfo& info, std::size_t steps = 0);

} // namespace isochron::index
